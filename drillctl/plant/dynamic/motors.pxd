# cython: language_level=3
# The C types of motors.py. Nothing of the law stands here.
cimport cython

cdef Py_ssize_t CURRENTS, SPEED, CYCLES, SUPPLY, OFF, NORMAL, FORCED, DECAY, EMF, KEEP, PUSH, DETENT, STOP, GAIN, ADVANCE
cdef Py_ssize_t SUBSTEPS, LIMIT, SPACING, WINDINGS, KIND, FORWARD, BACKWARD, RESTING, BEFORE, STIFF, DAMP, TRIP, LOW, HIGH, MOTOR
cdef Py_ssize_t MOST, WIRES
cdef Py_ssize_t UNIPOLAR, RELUCTANCE, DRIVE
cdef Py_ssize_t COUNT, SEEN, TRIPPED
cdef Py_ssize_t SINES, QUARTER

@cython.locals(decay=cython.double, emf=cython.double, keep=cython.double, push=cython.double, detent=cython.double, forward=cython.double, backward=cython.double,
               advance=cython.double, to_a=cython.double, to_b=cython.double, to_c=cython.double, to_d=cython.double, a=cython.double, b=cython.double, c=cython.double,
               d=cython.double, speed=cython.double, places=cython.double, cycle=cython.double, pace=cython.double, quarter=cython.Py_ssize_t, base=cython.double, turned=cython.double,
               _=cython.Py_ssize_t, place=cython.double,
               entry=cython.Py_ssize_t, part=cython.double, sin=cython.double, cos=cython.double, back=cython.double, goal=cython.double, pull=cython.double, hold=cython.double)
cpdef void unipolar(double[::1] rows, Py_ssize_t at, double[::1] sine, double[::1] slope) noexcept

@cython.locals(decay=cython.double, emf=cython.double, keep=cython.double, push=cython.double, limit=cython.double, spacing=cython.double, forward=cython.double,
               backward=cython.double, advance=cython.double, speed=cython.double, cycles=cython.double, windings=cython.Py_ssize_t,
               _=cython.Py_ssize_t, winding=cython.Py_ssize_t, turned=cython.double, back=cython.double, pull=cython.double, place=cython.double,
               entry=cython.Py_ssize_t, part=cython.double, sin=cython.double, current=cython.double, goal=cython.double)
cpdef void reluctance(double[::1] rows, Py_ssize_t at, double[::1] sine, double[::1] slope) noexcept

@cython.locals(level=cython.double, goal=cython.double, decay=cython.double, emf=cython.double, keep=cython.double, push=cython.double, limit=cython.double,
               most=cython.double, stiff=cython.double, damp=cython.double, trip=cython.double, forward=cython.double, backward=cython.double,
               advance=cython.double, tripped=cython.double, current=cython.double, speed=cython.double, cycles=cython.double, _=cython.Py_ssize_t,
               behind=cython.double, wanted=cython.double)
cpdef void drive(double[::1] rows, Py_ssize_t at) noexcept

@cython.locals(winding=cython.Py_ssize_t, speed=cython.double, cycles=cython.double, moved=cython.bint)
cpdef bint step(double[::1] rows, Py_ssize_t at, double[::1] sine, double[::1] slope) noexcept

@cython.locals(winding=cython.Py_ssize_t, level=cython.double)
cpdef void supply(double[::1] rows, Py_ssize_t at, unsigned long long[::1] wires, Py_ssize_t first,
                  unsigned long long image) noexcept

@cython.locals(forward=cython.double, backward=cython.double)
cpdef void load(double[::1] rows, Py_ssize_t at, double forward_nm, double backward_nm) noexcept
