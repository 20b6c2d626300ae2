# cython: language_level=3
# The C types of law.py. Nothing of the law stands here.
cimport cython

from drillctl.plant.dynamic cimport _motors as motors  # the compiled form of motors.py, called without Python

cdef Py_ssize_t ZERO, COLUMNS, START, PITCH, PLAY, PLACE, SCALE, MOVED, CARRIES, ROW
cdef Py_ssize_t LEFT, STILL, FIRST
cdef Py_ssize_t MOUNTED, HEAD, IN_BOARD, INVERTED, SURFACE, BOTTOM, BEGUN, WEAR, METRES, THRUST, GROWTH, LEVER, SAME, BEARS, SHORT, BROKEN, HOLE
cdef double TURN

@cython.locals(still=cython.bint, left=cython.bint, tick=cython.Py_ssize_t, axis=cython.Py_ssize_t, head=cython.Py_ssize_t, image=cython.ulonglong,
               seen=cython.Py_ssize_t)
cpdef Py_ssize_t run(double[::1] rows, Py_ssize_t axes, Py_ssize_t heads, unsigned long long[::1] wires, double[::1] bits,
                     unsigned long long[::1] images, Py_ssize_t ticks, double[::1] sine, double[::1] slope) noexcept

@cython.locals(thrust=cython.double, torque=cython.double, head=cython.Py_ssize_t)
cdef bint resist(double[::1] rows, Py_ssize_t axes, double[::1] bits, Py_ssize_t at) noexcept

@cython.locals(off=cython.double, away=cython.double, depth=cython.double, axis=cython.Py_ssize_t, head=cython.Py_ssize_t)
cdef double cut(double[::1] rows, Py_ssize_t axes, double[::1] bits, Py_ssize_t at) noexcept

@cython.locals(columns=cython.double, rotor=cython.double, place=cython.double)
cdef bint carry(double[::1] rows, Py_ssize_t at) noexcept
