#!/usr/bin/python3
"""A Modbus TCP device by pymodbus, for tests. Reads one command a line from stdin, and answers each with one line.

    modbus_plc.py PORT [--unit 1]

    set TABLE ADDRESS VALUE    get TABLE ADDRESS    delay SECONDS (of each answer)    refuse COIL (writes to it)
"""
import argparse
import asyncio
import sys
import threading
import time

from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.server import StartAsyncTcpServer

FUNCTION = {"coil": 1, "discrete_input": 2, "holding_register": 3, "input_register": 4}
SIZE = 64  # addresses of each table


class Unit(ModbusSlaveContext):
    delay_s = 0.0
    refused = None  # writes to this coil

    def validate(self, function, address, count=1):
        return not (function == 5 and address == self.refused) and super().validate(function, address, count)

    def getValues(self, *args, **kwargs):
        time.sleep(self.delay_s)
        return super().getValues(*args, **kwargs)


def block():
    return ModbusSequentialDataBlock(0, [0] * SIZE)


def obey(unit):
    print("listens", flush=True)
    for line in sys.stdin:
        words = line.split()
        if words[0] == "set":
            ModbusSlaveContext.setValues(unit, FUNCTION[words[1]], int(words[2]), [int(words[3])])
            print("done", flush=True)
        elif words[0] == "get":
            print(int(ModbusSlaveContext.getValues(unit, FUNCTION[words[1]], int(words[2]), 1)[0]), flush=True)
        elif words[0] == "refuse":
            unit.refused = int(words[1])
            print("done", flush=True)
        elif words[0] == "delay":
            unit.delay_s = float(words[1])
            print("done", flush=True)


async def serve(port, number):
    unit = Unit(co=block(), di=block(), hr=block(), ir=block(), zero_mode=True)
    threading.Timer(0.3, obey, [unit]).start()
    await StartAsyncTcpServer(context=ModbusServerContext(slaves={number: unit}, single=False),
                              address=("127.0.0.1", port), allow_reuse_address=True)


parser = argparse.ArgumentParser()
parser.add_argument("port", type=int)
parser.add_argument("--unit", type=int, default=1)
asked = parser.parse_args()
asyncio.run(serve(asked.port, asked.unit))
