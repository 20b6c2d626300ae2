"""What the paper's tables say, written out once for the tests that must agree with it."""

# Interrupts between steps of the seven-state automaton, by distance, as the readings of the paper's Table 2 give them.
INTERVALS = {
    1: [7],
    2: [7, 4],
    3: [7, 4, 7],
    4: [7, 4, 2, 4],
    5: [7, 4, 2, 4, 7],
    6: [7, 4, 2, 1, 2, 4],
    7: [7, 4, 2, 1, 2, 4, 7],
    8: [7, 4, 2, 1, 2, 2, 4, 7],
    9: [7, 4, 2, 1, 1, 2, 2, 4, 7],
    30: [7, 4, 2, *[1] * 23, 2, 2, 4, 7],
}
