"""Reads every PCB drill file there is, and says which format it recognised and why.

The map, in the order a file travels:

    reader      read(), decode(): the whole way in one page
    intake      bytes to text, bounded; asks sniff (what is this at all?) and eia (tape code)
    program     text to sentences: runs of coordinates, or single commands
    afterend      what stands behind M30
    lexer         the grammar
    commands      what each line does: names (keywords), G and M words (codes), T (toolwords), coordinates
    machine       modal state: where is it, which tool, drilling or routing
    rows          holes and slots; repeats and patterns
    cuts          the router's cuts; those that can be milled as slots
    tools         definitions and selection
    comments      what CAD programs say beside the commands
    sidefiles     what they say in reports beside the file
    facts         who declared what
    numbers       one number, read three ways: why the format can wait until the end
    recognise   which format it is; score weighs candidates
    checks      faults and warnings in millimetres; spacing finds overlapping holes
    model       DrillFile, the product; errors: DrillFileError and all codes
    summary     the product in a few words
    write       a clean file from a DrillFile
"""

from .cuts import milled
from .errors import DrillFileError, Remark
from .model import DrillFile, FormatChoice, Tool
from .reader import decode, read
from .summary import summary

__all__ = ["DrillFile", "DrillFileError", "FormatChoice", "Remark", "Tool", "decode", "milled", "read", "summary"]
