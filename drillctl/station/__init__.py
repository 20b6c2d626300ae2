"""The wiring of the screens: what panel/console.py asks for, made of the rooms below. Created by the screen verb.

    station    one machine kept running, one job after another     views      status, machine and job as drawn
    workbench  tables as the editors change them                   queuebench queues as the editor changes them
"""
