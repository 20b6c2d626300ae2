"""The same trace as ``tick``, without ticking: whole commands at once, in numpy, over the same tables.

    engine.py   looks at what waits in the queue, foresees as much of it as it can, and leaves the machine as if ticked
    batch.py   commands that were foreseen: ticks, holes, inputs; and what each axis puts out, as tapes
    axis_batch.py  where one axis is before and after each command
    move_profile.py  moves of one axis in one direction: ticks by distance, and the strips of images
    strokes.py  what ends on a sensor: run by tick once, then known
    plan.py     how many of the commands that wait can be foreseen
    stretch.py  ticks in the middle of a command: outputs until an input changes, ticks in which axes only count
    world.py    what the engine must know of the plant

Rule: tick is the law. Nothing is decided here: what can't be foreseen to the byte (homing, faults, requests, a sensor
in the way) is left to tick, and it finds the machine as if it had ticked all along. Image pool and tapes are those of
trace/tapes. Nothing is imported here: a ticker that passes stretches needs no batches.
"""
