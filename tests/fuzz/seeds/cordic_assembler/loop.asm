; A program that never ends: its jump goes back to the line.
.format q4.12
        MOV  Vmax, 2
        MOV  Amax, 1
        MOV  XI, 0x1000
LOOP:   MOV  YJ, 1
        G01
        MOV  YJ, -1
        G01
        MOV  PC, LOOP
