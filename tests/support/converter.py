"""A frequency converter at the other end of a serial line: a pair of pseudo terminals with a wire between them that can
be cut, noisy or slow, and the converters of tests/ticker/test_converter.py.
"""

import asyncio
import os
import select
import threading
import time
import tty
from collections.abc import Callable
from types import TracebackType
from typing import Self

from pymodbus import FramerType
from pymodbus.server import ModbusSerialServer
from pymodbus.simulator import DataType, SimData, SimDevice

from drillctl.ticker.converter.huanyang import crc16

WITHIN_S = 10.0


class Wire:
    """A line of two ends, ``ours`` and ``theirs`` (paths of devices). What goes wrong on the way to ours:

    cut    nothing comes through, either way
    noisy  every answer has a bit turned over
    late_s answers come so much later
    lost   how many pieces were lost while it was cut
    """

    def __init__(self) -> None:
        self.cut = self.noisy = False
        self.late_s = 0.0
        self.lost = 0
        self._masters, self._slaves = zip(*(os.openpty() for _ in range(2)), strict=True)
        for slave in self._slaves:
            tty.setraw(slave)
        self.ours, self.theirs = (os.ttyname(slave) for slave in self._slaves)
        self._ends, self._end = os.pipe()
        self._pump = threading.Thread(target=self._carry)
        self._pump.start()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *why: type[BaseException] | BaseException | TracebackType | None) -> None:
        os.write(self._end, b".")
        self._pump.join(WITHIN_S)
        for end in (*self._masters, *self._slaves, self._ends, self._end):
            os.close(end)

    def _carry(self) -> None:
        ours, theirs = self._masters
        while True:
            ready, _, _ = select.select([ours, theirs, self._ends], [], [])
            if self._ends in ready:
                return
            for end in ready:
                data = os.read(end, 256)
                if self.cut:
                    self.lost += 1
                    continue
                if end == theirs:
                    time.sleep(self.late_s)
                    data = bytes((data[0] ^ 4,)) + data[1:] if self.noisy else data
                os.write(theirs if end == ours else ours, data)


class ModbusConverter:
    """A Delta behind a pymodbus server. ``hz`` is what its motor does; ``lie`` answers in its place where it is set."""

    def __init__(self, device: str, baud: int):
        self.hz = self.set_hz = 0.0
        self.tripped = 0
        self.lie: Callable[[], float] | None = None
        self.writes: list[tuple[int, int]] = []
        self._device, self._baud = device, baud
        self._started = threading.Event()
        self._thread = threading.Thread(target=lambda: asyncio.run(self._serve()))

    def __enter__(self) -> Self:
        self._thread.start()
        assert self._started.wait(WITHIN_S)
        return self

    def __exit__(self, *why: type[BaseException] | BaseException | TracebackType | None) -> None:
        self._loop.call_soon_threadsafe(self._over.set)
        self._thread.join(WITHIN_S)

    async def _serve(self) -> None:
        self._loop, self._over = asyncio.get_running_loop(), asyncio.Event()
        blocks = [SimData(at, values=0, count=8, datatype=DataType.REGISTERS) for at in (0x2000, 0x2100)]
        device = SimDevice(id=1, simdata=blocks, action=self._answer)
        server = ModbusSerialServer(device, framer=FramerType.RTU, port=self._device, baudrate=self._baud)
        await server.serve_forever(background=True)
        self._started.set()
        await self._over.wait()
        await server.shutdown()

    async def _answer(
        self, function: int, start: int, address: int, count: int, registers: list[int], written: object
    ) -> None:
        if isinstance(written, list) and written:
            value = int(written[0])
            self.writes.append((address, value))
            if address == 0x2001:
                self.set_hz = value / 100
            elif address == 0x2000:
                self.hz = self.set_hz if value & 2 else 0.0
        else:
            hz = self.hz if self.lie is None else self.lie()
            for place, value in ((0x2100, self.tripped), (0x2102, round(self.set_hz * 100)), (0x2103, round(hz * 100))):
                if start <= place < start + len(registers):
                    registers[place - start] = value


def huanyang(request: bytes, state: dict[str, int]) -> bytes:
    """What a classic Huanyang answers to a whole frame; ``state`` has ``set`` and ``on``."""
    assert crc16(request[:-2]) == request[-2:]
    address, function, length = request[:3]
    data = request[3 : 3 + length]
    if function == 5:
        state["set"] = int.from_bytes(data, "big")
    elif function == 3:
        state["on"] = int(data == b"\x01")
    elif function == 4:
        value = state["set"] if data[0] == 0 else state["set"] * state["on"]
        data = data[:1] + value.to_bytes(2, "big")
    body = bytes((address, function, len(data))) + data
    return body + crc16(body)
