"""What only a production drill needs of layer 2: a machine with parameters, several spindles and a magazine of tools.

board.py     a drill file as a job            program.py   a work list as a program of KMD records
tools.py     which tool makes which holes     change.py    the steps of a tool change as records
feeds.py     speeds in ticks                  magazine.py  what is known of chucks and places of the magazine
transfers.py which records move a tool
"""
