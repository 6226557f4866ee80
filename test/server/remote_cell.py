"""A server whose two robots are `armloom arm` processes, each behind a proxy."""
import json
import re
import select
import signal
import socket
import subprocess
import threading
import time

from killed_server import API, ROOT, call, swing

PATIENCE_S = 120.0  # then the test hangs
ENDED = ("succeeded", "failed", "canceled", "interrupted")
# Causes of a stop on a machine that is too busy.
LATE = re.compile(r"link lost: (the last report is|no answer from|.* connected, but no report|.* sent no welcome)"
                  "|fault: the connection broke before the controller accepted the motion")


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

    def __init__(self, program, folder, start_arms=True):
        self.program, self.folder = str(program.resolve()), folder
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
        self.server = subprocess.Popen([self.program, "serve", "--cell", str(self.file), "--listen", "127.0.0.1:0", "--data",
                                        str(self.folder / "data")], stdout=subprocess.PIPE, stderr=self.log, text=True)
        self.port = int(self.server.stdout.readline().rsplit(":", 1)[1].strip("/\n"))

    def start_arm(self, arm):
        self.arms[arm] = subprocess.Popen([self.program, "arm", "--cell", str(self.file), "--robot", arm, "--listen",
                                           f"unix:{self.folder}/{arm}-robot.sock"], stdout=subprocess.PIPE,
                                          stderr=self.log, text=True)
        self.arms[arm].stdout.readline()

    def call(self, method, path, body=None):
        return call(self.port, method, API + path, body, PATIENCE_S)[1]

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

    def open_jobs(self, arm):
        """Returns the arm's jobs that have not ended. Resumes an arm that was stopped because the machine is busy."""
        jobs = [job for job in self.jobs(arm) if job["state"] not in ENDED]
        causes = {wait["detail"] for job in jobs for wait in job["waits_on"] if wait["kind"] == "stop"}
        for cause in causes:
            assert not cause.startswith("monitor: "), f"{arm} was stopped: {cause}"
        if any(map(LATE.match, causes)) and self.arm(arm)["link"] == "up":
            self.resume(arm)
        return jobs

    def await_motion(self, arm):
        last = self.proxies[arm].last
        wait_for(lambda: self.open_jobs(arm) and (now := self.proxies[arm].last) and now is not last and
                 now["phase"] == "moving" and now["commanded_ns"] > 0, f"motion of {arm}")

    def await_end(self, arm):
        wait_for(lambda: not self.open_jobs(arm), f"the end of {arm}")

    def waits(self):
        """Returns what the server says of its arms and open jobs, for the report of a failure."""
        try:
            arms = [f"{arm['name']}: {arm['state']}, link {arm['link']} {arm['link_detail']}"
                    for arm in self.call("GET", "/arms")["arms"]]
            jobs = [f"{job['id']}: {job['state']}, waits on {job['waits_on']}"
                    for job in self.call("GET", "/jobs?limit=100")["jobs"] if job["state"] not in ENDED]
            return "\n".join(arms + jobs)
        except OSError as error:
            return f"the server does not answer: {error}"

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
            assert process.wait(PATIENCE_S) == 0, f"ended with {process.returncode}"
        replayed = subprocess.run([self.program, "replay", "--data", str(self.folder / "data")], capture_output=True, text=True)
        assert replayed.returncode == 0, f"the session does not replay: {replayed.stdout}{replayed.stderr}"
        for arm, proxy in self.proxies.items():
            assert not proxy.faults, f"{arm} passed its authority: {proxy.faults[0]}"
