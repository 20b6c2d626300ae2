"""The VCD file of a finished run. What the record leaves out is found by running it again, and nothing is kept of that.

Rule: both engines' runs give the same bytes. A run that was ticked has its columns, positions, states and the plant's
lanes in its record; one of the fast engine is repeated, on the ideal plant that it was made on, batch by batch.
"""

from pathlib import Path

from drillctl.machine import Machine
from drillctl.plant import IdealPlant
from drillctl.replay.player import Player
from drillctl.ticker.fast_ticker import FastTicker
from drillctl.ticker.sampler import signals, vcd_layout
from drillctl.trace import Segments, Trace
from drillctl.trace.stretches import SignalRecorder
from drillctl.trace.target import Target
from drillctl.trace.vcd import write_vcd, write_vcd_run

COMMANDS_AT_ONCE = 96  # repeated: a batch of them is a few ten thousand ticks


def write_recorded_vcd(record: Trace | Segments, machine: Machine, target: Target) -> None:
    """Writes the run that a ticker of this machine has just recorded. Raises OSError as `open`."""
    frame = record.rest if isinstance(record, Segments) else record
    layout = vcd_layout(machine)
    if any(signal.derived for signal in frame.signals):
        write_vcd(frame, target, [var for var in layout if frame.has(var.source)])
        return
    found = signals(machine, IdealPlant.lanes, derived=True)
    names = {signal.name for signal in found}
    recorder = SignalRecorder(found)
    ticker = FastTicker.ideal(machine, traced=True, capacity=COMMANDS_AT_ONCE, keeper=recorder, rotors=True)
    player = Player(ticker, frame, machine, Path(machine.name))
    run = (recorder.taken() for _ in player.up_to(frame.end))
    write_vcd_run(frame, found, run, target, [var for var in layout if var.source in names])
