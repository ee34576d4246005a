; Words of 64 bits, and a byte that is no instruction.
.format q16.48
        MOV  Vmax, 0x0001000000000000
        MOV  XI, 32767.5
        MOV  YJ, -32768
        G01
        .byte 0x77
