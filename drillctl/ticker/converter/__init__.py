"""The spindle's frequency converter, on a serial line apart from the motion port, in a process of its own.

lines.py    what a line to a converter does, and the ones that speak Modbus RTU
huanyang.py the frames of the classic Huanyang
follower.py what is done with the line: sends the speed that is wanted, reads the one there is, judges the answers
card.py     a card around the port, whose words are shared with the converter's process
process.py  that process, and how it is started and ended
"""
