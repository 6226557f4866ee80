#!/usr/bin/env python3
"""Runs a server with a Modbus TCP device by pymodbus or jsmodbus (modbus_plc.*), and breaks the device and its connection.

    test/server/modbus_io.py ARMLOOM [--only CASE ...]
"""
import argparse
import json
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.request

from killed_server import API, ROOT, call
from remote_cell import wait_for

PYMODBUS = ["/usr/bin/python3", pathlib.Path(__file__).with_name("modbus_plc.py")]
JSMODBUS = ["node", pathlib.Path(__file__).with_name("modbus_plc.mjs")]
SIGNALS = [
    ("part_ready", "input", "discrete_input", 3, None), ("door_closed", "input", "discrete_input", 4, None),
    ("level", "input", "input_register", 10, None), ("valve", "output", "coil", 0, False),
    ("lamp", "output", "coil", 7, None), ("setpoint", "output", "holding_register", 2, 100)]

WRONG = [("beside", "input", "discrete_input", 63, None), ("wrong_input", "input", "discrete_input", 64, None),
         ("wrong_output", "output", "coil", 500, False)]


class Plant:
    """A server, and a device that can be started and ended. `wrong`: signals at addresses that the device does not have."""

    def __init__(self, program, folder, unit=1, wrong=()):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.device_port = free.getsockname()[1]
        text = (ROOT / "config/two_pandas.json").read_text().replace('"../models', f'"{ROOT}/models')
        signals = []
        for name, direction, table, address, fail_state in (*SIGNALS, *wrong):
            signals.append({"name": name, "direction": direction,
                            "modbus": {"device": "plc", "table": table, "address": address}})
            if fail_state is not None:
                signals[-1]["fail_state"] = fail_state
        signals.append({"name": "lane", "direction": "input"})
        io = {"devices": [{"name": "plc", "endpoint": f"tcp:127.0.0.1:{self.device_port}", "unit": unit,
                           "timeout_s": 0.4}], "signals": signals}
        file = folder / "cell.json"
        file.write_text(text[:text.rindex("}")].rstrip() + f',\n"io": {json.dumps(io)}}}\n')
        self.file, self.folder, self.device = file, folder, None
        self.log = open(folder / "log", "a", encoding="utf-8")
        self.server = subprocess.Popen([program, "serve", "--cell", str(file), "--listen", "127.0.0.1:0", "--data",
                                        str(folder / "data")], stdout=subprocess.PIPE, stderr=self.log, text=True)
        self.port = int(self.server.stdout.readline().rsplit(":", 1)[1].strip("/\n"))

    def start_device(self, *options, by=PYMODBUS):
        self.device = subprocess.Popen([*by, str(self.device_port), *options], stdin=subprocess.PIPE,
                                       stdout=subprocess.PIPE, stderr=self.log, text=True)
        assert self.device.stdout.readline() == "listens\n"

    def tell(self, command):
        self.device.stdin.write(command + "\n")
        self.device.stdin.flush()
        return self.device.stdout.readline().strip()

    def end_device(self):
        if self.device is not None:
            self.device.kill()
            self.device.wait()

    def call(self, method, path, body=None):
        return call(self.port, method, API + path, body)

    def io(self, name):
        return next(s for s in self.call("GET", "/io")[1]["signals"] if s["name"] == name)

    def put(self, name, value):
        return self.call("PUT", f"/io/{name}", {"value": value})

    def alerts(self):
        return [(a["level"], a["text"]) for a in self.call("GET", "/alerts")[1]["alerts"]]

    def not_connected(self):
        with urllib.request.urlopen(f"http://127.0.0.1:{self.port}/metrics", timeout=30) as answer:
            text = answer.read().decode()
        return float(re.search(r'armloom_io_signals_not_connected{device="plc"} (\S+)', text)[1])

    def await_up(self):
        wait_for(lambda: self.io("valve")["is_connected"], "a connection to the device")

    def end_server(self):
        self.server.send_signal(signal.SIGTERM)
        assert self.server.wait(60) == 0, self.server.returncode

    def end(self):
        for process in (self.server, self.device):
            if process is not None and process.poll() is None:
                process.kill()
                process.wait()


# ---- Cases ----

def case_reads_and_writes(plant, by=PYMODBUS):
    plant.start_device(by=by)
    plant.tell("set coil 7 1")  # an output without fail_state keeps what the device has
    plant.await_up()
    assert plant.io("lamp")["value"] is True, plant.io("lamp")
    assert plant.io("setpoint")["value"] == 100 and plant.tell("get holding_register 2") == "100"
    for table, address, name, value in (("discrete_input", 3, "part_ready", True), ("input_register", 10, "level", 65535)):
        plant.tell(f"set {table} {address} {int(value)}")
        wait_for(lambda: plant.io(name)["value"] == value, f"{name} to be {value}")
    assert plant.io("door_closed")["value"] is False
    for name, value, place in (("valve", True, "coil 0"), ("setpoint", 250, "holding_register 2")):
        status, signal_now = plant.put(name, value)
        assert status == 200 and value in (signal_now["value"], signal_now.get("commanded")), signal_now
        wait_for(lambda: plant.io(name)["value"] == value and "commanded" not in plant.io(name), f"{name} to be {value}")
        assert plant.tell(f"get {place}") == str(int(value))
    plant.end_server()
    assert plant.tell("get coil 0") == "0" and plant.tell("get holding_register 2") == "100", "no fail state at the end"
    assert plant.tell("get coil 7") == "1", "an output without a fail state was written"


def case_reads_and_writes_by_jsmodbus(plant):
    case_reads_and_writes(plant, JSMODBUS)


def case_refuses_what_is_wrong(plant):
    plant.start_device()
    plant.await_up()
    for name, value, status, words in (
            ("part_ready", True, 409, "input part_ready is read from device plc"), ("vlave", True, 404, "did you mean valve?"),
            ("valve", 1, 422, "takes true or false, found 1"), ("setpoint", True, 422, "a whole number from 0 to 65535"),
            ("setpoint", 65536, 422, "65535"), ("setpoint", 1.5, 400, "expected an integer, found number")):
        found, problem = plant.put(name, value)
        assert found == status and words in json.dumps(problem), (name, value, found, problem)
    assert plant.put("lane", True)[1]["value"] is True
    assert plant.io("valve")["value"] is False


def case_survives_the_loss_of_the_device(plant):
    assert "Connection refused" in wait_for(lambda: plant.io("level")["detail"], "a reason"), plant.io("level")
    assert plant.put("valve", True)[0] == 503
    plant.start_device()
    plant.await_up()
    plant.put("valve", True)
    wait_for(lambda: plant.io("valve")["value"] is True, "an open valve")
    job = {"id": "closed", "arm": "left", "move_to": {"named": "ready"}, "start_when": {"io": "valve", "value": False}}
    assert plant.call("POST", "/jobs", job)[0] == 202
    plant.end_device()
    wait_for(lambda: not plant.io("valve")["is_connected"], "a lost connection")
    waits = wait_for(lambda: plant.call("GET", "/jobs/closed")[1]["waits_on"], "a reason to wait")
    assert waits[0]["kind"] == "io" and "not known" in waits[0]["detail"], "an assumed value started a job"
    assert plant.io("valve")["value"] is False, "not the fail state"
    assert plant.io("level")["value"] is None and plant.io("lamp")["value"] is None
    plant.start_device()
    plant.await_up()
    assert plant.tell("get coil 0") == "0", "a value from before the loss was written again"
    wait_for(lambda: plant.call("GET", "/jobs/closed")[1]["state"] == "succeeded", "the job's end")


def case_raises_an_alert_and_a_metric(plant):
    lost = lambda: sum("I/O device plc is not connected: " in text for _, text in plant.alerts())
    wait_for(lambda: lost() == 1, "an alert")
    assert plant.alerts()[0][0] == "error" and plant.not_connected() == len(SIGNALS)
    plant.start_device()
    plant.await_up()
    wait_for(lambda: plant.not_connected() == 0, "all signals")
    plant.end_device()
    wait_for(lambda: lost() == 2, "an alert for the second loss")
    wait_for(lambda: plant.not_connected() == len(SIGNALS), "the metric")
    time.sleep(2.5)  # two more attempts to connect
    assert lost() == 2, plant.alerts()


def case_goes_on_without_a_signal_that_the_device_refuses(plant):
    plant.start_device()
    plant.await_up()
    wrong = plant.io("wrong_input")
    assert not wrong["is_connected"] and wrong["value"] is None, wrong
    assert "reading discrete_input 64 of unit 1: Illegal data address" in wrong["detail"], wrong
    assert "coil 500 of unit 1: Illegal data address" in plant.io("wrong_output")["detail"]
    plant.tell("set discrete_input 63 1")  # in one block with the wrong address
    wait_for(lambda: plant.io("beside")["value"] is True, "the signal beside it")
    assert plant.put("valve", True)[0] == 200
    wait_for(lambda: plant.io("valve")["value"] is True, "an open valve")
    status, problem = plant.put("wrong_output", True)
    assert status == 503 and "coil 500" in problem["detail"], problem
    told = lambda name: [text for _, text in plant.alerts() if f"plc refuses signal {name}: " in text]
    assert len(told("wrong_input")) == len(told("wrong_output")) == 1, plant.alerts()
    assert plant.not_connected() == 2

    plant.tell("refuse 7")  # the device has the coil, but does not accept a value
    assert plant.put("lamp", True)[0] == 200
    wait_for(lambda: "writing coil 7 of unit 1: Illegal data address (value true)" in (plant.io("lamp")["detail"] or ""), "a refusal")
    assert plant.io("valve")["is_connected"] and len(told("lamp")) == 1
    plant.tell("refuse 99")
    wait_for(lambda: plant.io("lamp")["is_connected"], "the lamp to be usable again")
    assert plant.io("lamp")["value"] is False, "the refused value was written later"
    assert plant.put("lamp", True)[0] == 200
    wait_for(lambda: plant.io("lamp")["value"] is True, "a lit lamp")


def case_says_that_a_slow_device_is_lost(plant):
    plant.start_device()
    plant.await_up()
    plant.tell("delay 2")
    detail = wait_for(lambda: plant.io("level")["detail"], "a lost connection")
    assert "no answer within 0.4 s" in detail, detail
    plant.tell("delay 0")
    plant.await_up()


def case_says_that_the_unit_is_wrong(plant):
    plant.start_device("--unit", "9")
    detail = wait_for(lambda: (d := plant.io("valve")["detail"]) and "refused" not in d and "yet" not in d and d, "a reason")
    assert "unit 1" in detail, detail


def case_follows_a_register_that_flickers(plant):
    plant.start_device()
    plant.await_up()
    seen = set()
    for i in range(3000):  # a loaded machine reads seldom
        plant.tell(f"set input_register 10 {i % 5}")
        seen.add(plant.io("level")["value"])
        if i >= 200 and len(seen) >= 3:
            break
    assert len(seen) >= 3, seen
    plant.tell("set input_register 10 77")
    wait_for(lambda: plant.io("level")["value"] == 77, "the last value")


def check_replay(program, folder):
    """The session repeats from its log, event by event."""
    recording = next((folder / "data").rglob("inputs.jsonl")).parent
    answer = subprocess.run([program, "replay", "--data", str(recording)], capture_output=True, text=True, timeout=120)
    assert answer.returncode == 0, answer.stdout + answer.stderr


CASES = {name[5:]: case for name, case in globals().items() if name.startswith("case_")}
parser = argparse.ArgumentParser()
parser.add_argument("program")
parser.add_argument("--only", nargs="+", default=list(CASES))
options = parser.parse_args()
options.program = str(pathlib.Path(options.program).resolve())
for case in options.only:
    begun = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="armloom-io-") as place:
        plant = Plant(options.program, pathlib.Path(place), wrong=WRONG if "refuses" in case else ())
        try:
            CASES[case](plant)
            if plant.server.poll() is None:
                plant.end_server()
            check_replay(options.program, pathlib.Path(place))
        except BaseException:
            print((pathlib.Path(place) / "log").read_text()[-3000:], file=sys.stderr)
            raise
        finally:
            plant.end()
    print(f"{case}: {time.monotonic() - begun:.1f} s", flush=True)
