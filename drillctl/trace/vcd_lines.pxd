# cython: language_level=3
# The C types of vcd_lines.py. Nothing of the loop stands here.
cimport cython

cdef Py_ssize_t SHIFT, MASK, INVERT, FIRST, COUNT, BITS, FIELDS, TIME, WHY, WHICH, DONE, FULL, NO_TEXT

@cython.locals(digits=cython.Py_ssize_t, at=cython.Py_ssize_t, power=cython.longlong)
cpdef Py_ssize_t stamp(unsigned char[::1] out, Py_ssize_t used, long long time) noexcept

@cython.locals(bit=cython.int, half=cython.int)
cpdef Py_ssize_t number(unsigned char[::1] out, Py_ssize_t used, long long value) noexcept

@cython.locals(at=cython.Py_ssize_t)
cpdef Py_ssize_t text(unsigned char[::1] out, Py_ssize_t used, const unsigned char[::1] texts, Py_ssize_t begin,
                      Py_ssize_t end) noexcept

@cython.locals(signal=cython.Py_ssize_t, least=cython.longlong)
cpdef long long come(const long long[::1] ticks, const long long[::1] at, const long long[::1] ends, long long beyond,
                     long long[::1] coming) noexcept

@cython.locals(signal=cython.Py_ssize_t, least=cython.longlong)
cpdef long long take(long long tick, long long beyond, const long long[::1] ticks, const long long[::1] values,
                     long long[::1] at, const long long[::1] ends, long long[::1] coming, long long[::1] present,
                     long long[::1] changed) noexcept

@cython.locals(used=cython.Py_ssize_t, tick=cython.longlong, time=cython.longlong,
               row=cython.Py_ssize_t, source=cython.Py_ssize_t, count=cython.Py_ssize_t,
               beyond=cython.longlong, full=cython.Py_ssize_t, variable=cython.Py_ssize_t, now=cython.longlong, place=cython.Py_ssize_t)
cpdef Py_ssize_t lines(const long long[::1] ticks, const long long[::1] values, long long[::1] at,
                       const long long[::1] ends, long long[::1] coming, long long[::1] present,
                       long long[::1] changed, const long long[::1] variables, long long[::1] shown,
                       const unsigned char[::1] texts, const long long[::1] begins, long long first,
                       const long long[::1] times, unsigned char[::1] out, Py_ssize_t room, long long[::1] state) noexcept
