#!/usr/bin/env python3
"""Runs jobs on arms in other processes, and breaks these processes and their connections.

    test/server/remote_arms.py ARMLOOM [--only CASE ...] [--cuts 12] [--seed 1]

Each robot of config/two_pandas_remote.json is an `armloom arm` process behind a proxy, which delays messages, cuts the
connection, and reads all messages. In every case
- no arm passes the authority that it has acknowledged,
- an arm whose process or connection broke comes to rest, and does not move before it is resumed,
- the other arm goes on,
- `armloom replay` reproduces the session from its log.
"""
import argparse
import json
import pathlib
import random
import select
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.request

from killed_server import API, HOME, ROOT, swing

PATIENCE_S = 60.0
ENDED = ("succeeded", "failed", "canceled", "interrupted")
PROGRAM = None


def wait_for(holds, what):
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        found = holds()
        if found:
            return found
        time.sleep(0.02)
    raise AssertionError(f"waited in vain for {what}")


def message_in(line):
    try:
        return json.loads(line)
    except ValueError:
        return {"type": ""}


class Proxy:
    """Stands between the server and one robot, and checks that no report is beyond the authority it states."""

    def __init__(self, place, target):
        self.target, self.delay_s, self.cut_at, self.faults = str(target), 0.0, None, []
        self.last = None  # report of the arm
        self.moves = self.count = self.connections = 0
        self.open = []
        self.listening = socket.socket(socket.AF_UNIX)
        self.listening.bind(str(place))
        self.listening.listen()
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            server = self.listening.accept()[0]
            robot = socket.socket(socket.AF_UNIX)
            try:
                robot.connect(self.target)
            except OSError:
                server.close()
                continue
            self.open, self.connections = [server, robot], self.connections + 1
            for source, sink, hears in ((server, robot, self.hear_server), (robot, server, self.hear_robot)):
                threading.Thread(target=self.carry, args=(source, sink, hears), daemon=True).start()

    def carry(self, source, sink, hears):
        """Passes messages on after the delay, even while the other end does not read."""
        waiting, data, unsent = [], b"", b""
        try:
            while True:
                if select.select([source], [], [], 0.002)[0]:
                    chunk = source.recv(1 << 20)
                    if not chunk:
                        self.send(sink, unsent)
                        break
                    *lines, data = (data + chunk).split(b"\n")
                    waiting += [(time.monotonic() + self.delay_s, line) for line in lines]
                    if hears == self.hear_robot:
                        for line in lines:
                            hears(message_in(line))
                while waiting and waiting[0][0] <= time.monotonic():
                    line = waiting.pop(0)[1]
                    unsent += line + b"\n"
                    unsent = self.send(sink, unsent)
                    if hears == self.hear_server:
                        hears(message_in(line))
                unsent = self.send(sink, unsent)
        except OSError:
            pass
        self.cut([source, sink])

    @staticmethod
    def send(sink, data):
        """Returns what could not be sent yet."""
        try:
            return data[sink.send(data, socket.MSG_DONTWAIT):] if data else data
        except BlockingIOError:
            return data

    @staticmethod
    def cut(ends):
        for end in ends:
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def hear_server(self, message):
        if message["type"] in ("heartbeat", "hello"):
            return
        self.moves += message["type"] == "follow"
        self.count += 1
        if self.count == self.cut_at:
            self.cut_at = None
            self.cut(self.open)

    def hear_robot(self, message):
        if message["type"] != "feedback":
            return
        self.last = message
        if message["commanded_ns"] > message["authority_ns"] and message["phase"] != "fault":
            self.faults.append(message)


class Cell:
    """The server, two robots and their proxies."""

    def __init__(self, folder, start_arms=True):
        self.folder = folder
        text = (ROOT / "config/two_pandas_remote.json").read_text().replace('"../models', f'"{ROOT}/models')
        text = text.replace("/tmp/armloom-", f"{folder}/")
        # A busy machine is late, so the feedback timeout is long.
        text = text.replace('"feedback_timeout_s": 0.2', '"feedback_timeout_s": 0.8')
        self.file = folder / "cell.json"
        self.file.write_text(text)
        self.proxies = {arm: Proxy(folder / f"{arm}.sock", folder / f"{arm}-robot.sock") for arm in ("left", "right")}
        self.log = open(folder / "log", "a", encoding="utf-8")
        self.arms = {}
        if start_arms:
            for arm in self.proxies:
                self.start_arm(arm)
        self.start_server()

    def start_server(self):
        self.server = subprocess.Popen([PROGRAM, "serve", "--cell", str(self.file), "--listen", "127.0.0.1:0", "--data",
                                        str(self.folder / "data")], stdout=subprocess.PIPE, stderr=self.log, text=True)
        self.port = int(self.server.stdout.readline().rsplit(":", 1)[1].strip("/\n"))

    def start_arm(self, arm):
        self.arms[arm] = subprocess.Popen([PROGRAM, "arm", "--cell", str(self.file), "--robot", arm, "--listen",
                                           f"unix:{self.folder}/{arm}-robot.sock"], stdout=subprocess.PIPE,
                                          stderr=self.log, text=True)
        self.arms[arm].stdout.readline()

    def call(self, method, path, body=None):
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}{API}{path}", method=method,
                                         data=None if body is None else json.dumps(body).encode(),
                                         headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=20) as answer:
                return json.loads(answer.read() or b"null")
        except urllib.error.HTTPError as error:
            return json.loads(error.read() or b"null")

    def submit(self, count, duration_s=1.5):
        for i in range(count):
            for arm in self.proxies:
                answer = self.call("POST", "/jobs", swing(f"{arm}-{time.monotonic_ns()}", arm, duration_s, []))
                assert "state" in answer, answer

    def jobs(self, arm):
        return [job for job in self.call("GET", "/jobs?limit=100")["jobs"] if job["arms"] == [arm]]

    def arm(self, name):
        return next(arm for arm in self.call("GET", "/arms")["arms"] if arm["name"] == name)

    def await_up(self):
        wait_for(lambda: all(self.arm(arm)["link"] == "up" for arm in self.proxies), "links that are up")

    def await_motion(self, arm):
        last = self.proxies[arm].last
        wait_for(lambda: (now := self.proxies[arm].last) and now is not last and now["phase"] == "moving"
                 and now["commanded_ns"] > 0, f"motion of {arm}")

    def await_end(self, arm):
        wait_for(lambda: all(job["state"] in ENDED for job in self.jobs(arm)), f"the end of {arm}")

    def await_stop(self, arm):
        wait_for(lambda: self.is_stopped(arm) or self.arm(arm)["link"] == "lost", f"a stop of {arm}")

    def is_stopped(self, arm):
        return self.arm(arm)["state"] in ("stopped", "fault")

    def stays_until_resumed(self, arm):
        """The arm's link is up again, and its arm must rest until it is resumed."""
        wait_for(lambda: self.arm(arm)["link"] == "up", f"the link of {arm}")
        wait_for(lambda: self.proxies[arm].last["at_rest"], f"a rest of {arm}")
        place, moves = self.proxies[arm].last["positions"], self.proxies[arm].moves
        sequence = self.proxies[arm].last["sequence"]
        wait_for(lambda: self.proxies[arm].last["sequence"] > sequence + 50, "reports")
        assert self.proxies[arm].last["positions"] == place, f"{arm} moved before it was resumed"
        assert self.proxies[arm].moves == moves, f"{arm} was sent a motion before it was resumed"
        waits = [job for job in self.jobs(arm) if job["state"] not in ENDED]
        assert all(job["waits_on"] for job in waits), f"a job does not say what it waits for: {waits}"

    def resume(self, arm):
        self.call("POST", f"/arms/{arm}/resume")

    def close(self):
        for process in [self.server, *self.arms.values()]:
            process.send_signal(signal.SIGCONT)
            process.terminate()
        for process in [self.server, *self.arms.values()]:
            assert process.wait(20) == 0, f"ended with {process.returncode}"
        replayed = subprocess.run([PROGRAM, "replay", "--data", str(self.folder / "data")], capture_output=True, text=True)
        assert replayed.returncode == 0, f"the session does not replay: {replayed.stdout}{replayed.stderr}"
        for arm, proxy in self.proxies.items():
            assert not proxy.faults, f"{arm} passed its authority: {proxy.faults[0]}"


# ---- Cases ----

def case_runs_jobs(cell, options):
    cell.await_up()
    cell.submit(3)
    for arm in cell.proxies:
        cell.await_end(arm)
        assert all(job["state"] == "succeeded" for job in cell.jobs(arm)), cell.jobs(arm)


def case_runs_jobs_over_a_slow_line(cell, options):
    cell.await_up()
    for delay_s in (0.01, 0.1, 0.25):  # each way
        for proxy in cell.proxies.values():
            proxy.delay_s = delay_s
        cell.submit(1)
        for arm in cell.proxies:
            wait_for(lambda arm=arm: cell.is_stopped(arm) or
                     all(job["state"] == "succeeded" for job in cell.jobs(arm)), f"an end of {arm}")
            if cell.is_stopped(arm):  # the change of the delay itself
                cell.stays_until_resumed(arm)
                cell.resume(arm)
                cell.await_end(arm)


def case_waits_for_its_arms(cell, options):
    wait_for(lambda: cell.arm("left")["link"] == "connecting", "a link that connects")
    assert cell.arm("left")["link_detail"], "the arm does not say why it waits"
    cell.submit(1)
    job = wait_for(lambda: next((job for job in cell.jobs("left") if job["waits_on"]), None), "a waiting job")
    assert job["state"] in ("queued", "backlogged"), job
    for arm in cell.proxies:
        cell.start_arm(arm)
    cell.await_up()
    for arm in cell.proxies:
        if cell.is_stopped(arm):
            cell.resume(arm)
        cell.await_end(arm)


def case_says_why_a_robot_does_not_fit(cell, options):
    """Answers the server's hello for the left robot with other lines; no arm is commanded."""
    joints = [f"left_panda_joint{i}" for i in range(1, 8)] + ["left_panda_finger_joint1"]
    fits = {"type": "welcome", "protocol": 1, "robot": "left", "arms": [{"name": "left", "joints": joints}],
            "reaction_s": 0.001, "feedback_period_s": 0.004}
    report = {"type": "feedback", "arm": "left", "sequence": 1, "time_ns": 1, "acknowledged": 0, "rejected": 0,
              "phase": "idle", "commanded_ns": 0, "measured_ns": 0, "authority_ns": 0, "positions": [0.0],
              "drives_on": True, "at_rest": True}
    answers = [({**fits, "robot": "right"}, 'robot "right" answers at unix:'),
               ({**fits, "protocol": 2}, "speaks version 2 of the protocol, this server version 1"),
               ({**fits, "feedback_period_s": 0.5}, "promises a feedback_period_s of 0.5"),
               ({**fits, "arms": [{"name": "left", "joints": joints[1:]}]}, "the joints of arm"),
               ({**fits, "arms": []}, "has 0 arms"),
               ({**fits, "speed": 1}, "/speed: "),
               ({"type": "error", "pointer": "/session", "detail": "in use"}, "refused the connection: /session: in use"),
               (report, "before its welcome"),
               ([fits, report], 'reports 1 positions of arm "left", which has 8 joints'),
               ("nonsense", "sent a bad message")]
    answer, said = answers[0]
    listening = socket.socket(socket.AF_UNIX)
    listening.bind(cell.proxies["left"].target)
    listening.listen()

    def serve():
        while True:
            peer = listening.accept()[0]
            peer.recv(1 << 20)
            for line in answer if isinstance(answer, list) else [answer]:
                peer.sendall((line if isinstance(line, str) else json.dumps(line)).encode() + b"\n")

    threading.Thread(target=serve, daemon=True).start()
    cell.submit(1)
    for answer, said in answers:
        wait_for(lambda: said in (cell.arm("left")["link_detail"] or ""), said)
        assert cell.arm("left")["state"] == "stopped" and cell.proxies["left"].moves == 0
    wait_for(lambda: "right.sock: " in cell.arm("right")["link_detail"], "a reason for the robot that is not there")


def case_refuses_bad_input(cell, options):
    cell.await_up()
    arm = ["arm", "--cell", str(cell.file), "--robot", "left", "--listen"]
    for arguments, said in [
            (["serve", "--cell", str(cell.file), "--listen", "127.0.0.1:0", "--speed", "2"], "--speed: robot left has a remote"),
            ([*arm, "left.sock"], "--listen: not an endpoint: expected unix:PATH or tcp:HOST:PORT"),
            ([*arm, f"unix:{cell.folder}/left-robot.sock"], "Address already in use"),
            ([*arm, f"unix:{cell.folder}/none/left.sock"], "No such file or directory"),
            (["arm", "--cell", str(cell.file), "--robot", "middle", "--listen", "tcp:127.0.0.1:0"],
             "--robot: the cell has no such robot; it has: left, right (found \"middle\")"),
            (["arm", "--cell", str(cell.file), "--robot", "left"], "--listen is required")]:
        ended = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60)
        assert ended.returncode == 2 and said in ended.stderr + ended.stdout, f"{arguments}: {ended}"
    answer = cell.call("PUT", "/sim/speed", {"speed": 2.0})
    assert "real time" in json.dumps(answer), answer


def other_goes_on(cell, breaks, mends):
    """Breaks the left arm in motion; the right one must finish its jobs."""
    cell.await_up()
    cell.submit(2, 2.0)
    cell.await_motion("left")
    breaks()
    cell.await_stop("left")
    mends()
    cell.stays_until_resumed("left")
    for job in cell.jobs("right"):
        assert job["state"] != "failed", job
    cell.resume("left")
    for arm in ("right", "left"):
        cell.await_end(arm)
    assert all(job["state"] == "succeeded" for job in cell.jobs("right")), cell.jobs("right")


def case_process_is_frozen(cell, options):
    other_goes_on(cell, lambda: cell.arms["left"].send_signal(signal.SIGSTOP),
                  lambda: cell.arms["left"].send_signal(signal.SIGCONT))


def case_process_is_killed(cell, options):
    def kill():
        cell.arms["left"].kill()
        cell.arms["left"].wait()

    other_goes_on(cell, kill, lambda: cell.start_arm("left"))


def case_connection_is_cut(cell, options):
    other_goes_on(cell, lambda: Proxy.cut(cell.proxies["left"].open), lambda: None)


def case_connection_is_cut_at_each_message(cell, options):
    cell.await_up()
    rng, reached = random.Random(options.seed), 0
    for number in range(1, options.cuts + 1):
        arm = rng.choice(list(cell.proxies))
        proxy = cell.proxies[arm]
        proxy.count, proxy.cut_at, connections = 0, number, proxy.connections
        cell.submit(1)
        wait_for(lambda: proxy.cut_at is None or all(
            job["state"] in ENDED for job in cell.jobs(arm)), f"message {number}")
        reached += proxy.cut_at is None
        if proxy.cut_at is None:
            wait_for(lambda: proxy.connections > connections, "the next connection")
            wait_for(lambda: cell.is_stopped(arm), f"a stop of {arm}")
            cell.stays_until_resumed(arm)
        proxy.cut_at = None
        for name in cell.proxies:
            if cell.is_stopped(name):
                cell.resume(name)
            cell.await_end(name)
    assert reached >= 2, f"only {reached} cuts came where they were to"


def case_server_is_killed(cell, options):
    cell.await_up()
    cell.submit(2, 3.0)
    for arm in cell.proxies:
        cell.await_motion(arm)
    cell.server.kill()
    cell.server.wait()
    cell.start_server()
    cell.await_up()
    for arm, proxy in cell.proxies.items():
        wait_for(lambda proxy=proxy: proxy.last["phase"] == "idle", f"the end of the motion of another session of {arm}")
        assert cell.is_stopped(arm), f"{arm} may move before it is resumed"
        cell.stays_until_resumed(arm)
    cell.call("POST", "/resume")
    wait_for(lambda: all(job["state"] in ENDED for arm in cell.proxies for job in cell.jobs(arm)), "the end of all jobs")


def case_server_is_frozen(cell, options):
    cell.await_up()
    cell.submit(1, 3.0)
    for arm in cell.proxies:
        cell.await_motion(arm)
    cell.server.send_signal(signal.SIGSTOP)
    for arm, proxy in cell.proxies.items():
        wait_for(lambda proxy=proxy: proxy.last["phase"] == "stopped", f"a brake of {arm}")
        assert proxy.last["commanded_ns"] < 3_000_000_000, "did not brake"
    cell.server.send_signal(signal.SIGCONT)
    for arm in cell.proxies:
        wait_for(lambda arm=arm: cell.arm(arm)["link"] == "up", f"the link of {arm}")


CASES = {name[5:]: case for name, case in list(globals().items()) if name.startswith("case_")}


def main():
    global PROGRAM
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--only", nargs="+", choices=list(CASES), default=list(CASES))
    parser.add_argument("--cuts", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    PROGRAM = str(options.program.resolve())
    for name in options.only:
        began = time.monotonic()
        with tempfile.TemporaryDirectory(prefix="armloom-remote-") as folder:
            cell = Cell(pathlib.Path(folder), start_arms=name not in ("waits_for_its_arms", "says_why_a_robot_does_not_fit"))
            try:
                CASES[name](cell, options)
                cell.close()
            except BaseException:
                for process in [cell.server, *cell.arms.values()]:
                    process.kill()
                print((pathlib.Path(folder) / "log").read_text(), file=sys.stderr)
                raise
        print(f"{name}: passed in {time.monotonic() - began:.1f} s", flush=True)


if __name__ == "__main__":
    main()
