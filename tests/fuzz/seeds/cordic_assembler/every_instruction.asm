; Every instruction and register, a label, bits, and a page left by PAGE.
.format f32
START:  NOP
        MOV   Vmax, 50
        MOV   Amax, 500
        MOV   XI, 1.5
        MOV   YJ, -2e-1
        G00
        G01
        MOV   Z, 0x3f800000
        G00Z
        G01Z
        MOV   XI, 0
        MOV   YJ, 0
        MOV   Dz, 0.125
        MOV   N, 3
        G02
        MOV   N, 3
        G03
        MOV   N, 2
        G02Z
        MOV   N, 2
        G03Z
        MOV   X0, 0
        MOV   Y0, 0
        MOV   Z0, 0
        MOV   Vx, 0
        MOV   Vy, 0
        MOV   Ax, 0
        MOV   Ay, 0
        MOV   P, 1000
        M03
        M04
        M05
        M06
        M07
        M08
        M09
        G04
        M00
        M01
        MOV   P, 110
        MUSER
        ST    Vz, 0x8000
        LD    XI, 0x8000
        LD    N, START
        MOV   PC, NEXT
        HLT
NEXT:   PAGE
.page
        M30
        M02
