"""A server to be killed, and the time of the kill."""
import json
import os
import pathlib
import subprocess
import time
import urllib.error
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[2]
HOME = [0, -1.2, 0, -2.6, 0, 1.6, 0.785]
API = "/api/v1"


def swing(job_id, arm, duration_s, after):
    """Returns a job that moves away and back, so that it can start where any other job has ended."""
    away = [HOME[0] + (0.3 if arm == "left" else -0.3)] + HOME[1:]
    still = [0.0] * 7
    points = [{"positions": q, "velocities": still, "time_from_start": duration_s * i / 2}
              for i, q in enumerate((HOME, away, HOME))]
    return {"id": job_id, "after": after, "trajectory": {
        "joint_names": [f"{arm}_panda_joint{j}" for j in range(1, 8)], "points": points}}


class Kill:
    """When the server ends: at the `nth` occurrence of `kind`."""
    KINDS = ["time", "change"]
    TRACED = ["fdatasync", "pwrite64", "full disk", "broken disk"]
    POWER_CUT = "power cut"

    def __init__(self, kind, nth):
        self.kind, self.nth = kind, nth

    def __str__(self):
        return f"{self.kind} {self.nth}"

    def tracer(self):
        """Returns the strace command; -D keeps the server our child. With --seccomp-bpf no signal would be sent."""
        inject = {"fdatasync": f"fdatasync:signal=KILL:when={self.nth}",
                  "pwrite64": f"pwrite64:signal=KILL:when={self.nth}",
                  "full disk": f"pwrite64:error=ENOSPC:when={self.nth}..{self.nth + 4}",
                  "broken disk": f"fdatasync:error=EIO:when={self.nth}..{self.nth + 1}"}.get(self.kind)
        if inject is None:
            return []
        return ["strace", "-D", "-f", "-qq", "-o", "/dev/null",
                "-e", "trace=" + inject.split(":")[0], "-e", "inject=" + inject]

    def cuts_power(self):
        return self.kind == self.POWER_CUT

    def may_hinder_start(self):
        return bool(self.tracer()) or self.cuts_power()

    def await_and_kill(self, server, rng):
        """Kills the server; returns True if the kill came at the intended point."""
        if self.kind == "change":
            came = server.wait_for_changes(self.nth)
        elif self.kind in ("fdatasync", "pwrite64", self.POWER_CUT):
            came = server.ends_within(1.5)
        else:
            came = not server.ends_within(rng.uniform(0.0, 0.6))
        server.kill()
        return came


def call(port, method, path, body=None, timeout_s=20):
    """Returns the status and the parsed body of the answer."""
    request = urllib.request.Request(f"http://127.0.0.1:{port}{path}", method=method,
                                     data=None if body is None else json.dumps(body).encode(),
                                     headers={"Content-Type": "application/json"})
    try:
        with urllib.request.urlopen(request, timeout=timeout_s) as answer:
            return answer.status, json.loads(answer.read() or b"null")
    except urllib.error.HTTPError as error:
        return error.code, json.loads(error.read() or b"null")


class NotUp(Exception):
    pass


class Server:
    def __init__(self, program, data, log, tracer=(), environment=None, cell="two_pandas.json",
                 speed=5):
        self.began = time.monotonic()
        self.process = subprocess.Popen(
            [*tracer, program, "serve", "--cell", str(ROOT / "config" / cell), "--speed", str(speed),
             "--listen", "127.0.0.1:0", "--data", str(data)],
            stdout=subprocess.PIPE, stderr=log, text=True, env={**os.environ, **(environment or {})})
        line = self.process.stdout.readline()
        if ":" not in line:
            self.kill()
            raise NotUp(f"the server did not come up: {line!r}, see {log.name}")
        self.port = int(line.rsplit(":", 1)[1].strip("/\n"))

    def ends_within(self, seconds):
        try:
            self.process.wait(seconds)
            return True
        except subprocess.TimeoutExpired:
            return False

    def wait_for_changes(self, count):
        """Returns True if `count` job events were published within two seconds."""
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{self.port}{API}/events?poses=0", timeout=2) as events:
                until = time.monotonic() + 2
                for line in events:
                    count -= line.startswith(b"data: ") and b'"type":"job"' in line
                    if count <= 0 or time.monotonic() > until:
                        return count <= 0
        except OSError:
            pass
        return False

    def call(self, method, path, body=None):
        return call(self.port, method, path, body)

    def kill(self):
        self.process.kill()
        self.process.wait()
