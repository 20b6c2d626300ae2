"""Traces: one columnar record of a run, and the forms it is stored and shown in.

Rule: knows no machine and no other room but files. What a run puts in comes out the same to the byte: no clock, path or
host is ever written.

    values     four kinds of value (word, count, name, command): how each is shown, read and checked
    record     Signal, Recorder -> Trace: columns tick, signal, value; changes only
    text       Trace -> text file, the form of golden files
    reader     text file -> Trace, or a TraceError that names file and line; text_lines, text_changes: its parts
    text_summary  a text trace whose outputs are only summed up
    diff       the first tick at which two traces differ, and the command it happened in
    tapes      pool of port images, and the output of an axis as slices of it
    segments   a trace in the segment form; segment_file: as a file
    stretches  a run piece by piece, for those who don't keep it
    vcd        Trace -> VCD for GTKWave, PulseView and others; vcd_layout: its variables, vcd_variables: what they show,
               vcd_compiled: the changes as text by a compiled loop, vcd_lines; vcd_pages: by numpy, without it
    shape      a signal as a dense array, one value a tick
    ring       a recorder in memory that two processes share
    lanes      the changes of a run that goes on, one lane for each signal or bit: what the scope draws
    tape_lanes the same for the outputs of a run in segments, which are not made into changes
    target     a path or an open file, for all that write
"""

from drillctl.trace.diff import Difference, first_difference, render
from drillctl.trace.reader import read_text
from drillctl.trace.record import Recorder, Signal, Trace
from drillctl.trace.segment_file import is_segments, read_segments, segment_bytes
from drillctl.trace.segments import Segments
from drillctl.trace.shape import dense
from drillctl.trace.text import is_trace, write_text
from drillctl.trace.text_lines import TraceError
from drillctl.trace.values import named_signal_kind, pack_command
from drillctl.trace.vcd_layout import VcdLayout, VcdVar

__all__ = [
    "Difference",
    "Recorder",
    "Segments",
    "Signal",
    "Trace",
    "TraceError",
    "VcdLayout",
    "VcdVar",
    "dense",
    "first_difference",
    "is_segments",
    "is_trace",
    "named_signal_kind",
    "pack_command",
    "read_segments",
    "read_text",
    "render",
    "segment_bytes",
    "write_text",
]
