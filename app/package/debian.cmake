# The Debian package of the suite that this runs on.
cmake_host_system_information(RESULT suite QUERY DISTRIB_VERSION_CODENAME)
set(maintainer "Millwright maintainers <maintainers@millwright.invalid>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL}) # as Debian's own tools take them
    set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()

# Debian's changelog has the version of the package in its first line, and its date.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC) # of SOURCE_DATE_EPOCH, where it is set
file(CONFIGURE OUTPUT changelog.Debian CONTENT "millwright (${PROJECT_VERSION}-1~${suite}) unstable; urgency=medium

  * See /usr/share/doc/millwright/changelog.gz.

 -- ${maintainer}  ${date}
")
set(changelog_of_debian ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian)
add_custom_command(
    OUTPUT ${changelog_of_debian}.gz
    COMMAND gzip -9nc ${changelog_of_debian} > ${changelog_of_debian}.gz
    DEPENDS ${changelog_of_debian})
add_custom_target(package_changelog ALL DEPENDS ${changelog_of_debian}.gz)
install(FILES ${changelog_of_debian}.gz DESTINATION share/doc/millwright)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_NAME millwright)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "plan, check and run programs of 5-axis machines")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1~${suite})
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${maintainer})
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Loaded or read at run time, so that shlibdeps does not see them.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "fonts-dejavu-core, fonts-font-awesome, fonts-inter, libegl1, libgl1")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS openmpi-bin) # for studies on many processors
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "On a 5-axis machine the tool does not go straight between two points
of a path: the axes turn while they move, and the tool swings off the
surface. Millwright shows where and by how much, moves the points of the
path to where they are needed, writes the G-code and runs it on a virtual
or a real machine.
.
It reads surfaces from STEP, IGES and mesh files, G-code of other programs,
HPGL plots and pictures, and talks to LinuxCNC, Grbl and a few other
controllers.")
include(CPack)
