"""What only the boiler-drum drill needs of layer 2: part programs in sentences, their gears, and the two stores.

gears.py      the sixteen speeds             sentence.py  one sentence: text, three bytes, plain words
text.py       ``.sentences`` files           program.py   sentences as a program of KMD records, within the travel
cells.py      8,192 cells: directory and programs as the 8031 reads them
store_file.py the file of a store            stores.py    EPROM and RAM of a machine, workpieces by number
names.py      how files and workpieces are named
part.py       a part program as a job        pattern.py   rows of holes to sentences
holes.py      where a program drills         times.py     how long its commands take
"""
