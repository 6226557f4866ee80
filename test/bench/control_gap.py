#!/usr/bin/env python3
"""How long the control loop is held up, and how long POST /stop takes, while batches come in.

    test/bench/control_gap.py ARMLOOM [--waiting 9000] [--batches 3]

Fills the queue of two Pandas by batches of 1,000 jobs; then more of them come in and are canceled one
by one, while another client stops and resumes all arms without a pause. Gaps are the server's own
figures of its control period (/metrics); beside them the gaps of a loop of another process that only
sleeps for a millisecond at a time: what the machine caused.
"""
import argparse
import http.client
import json
import multiprocessing
import re
import threading
import time

from latency import HOME, TOP, start_server

BATCH = 1000


class Server:
    def __init__(self, armloom):
        cell = str(TOP / "config/two_pandas.json")
        self.process, self.port = start_server([armloom, "serve", "--cell", cell])
        self.jobs = 0

    def call(self, method, path, body=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=120)
        connection.request(method, path, body and json.dumps(body), {"Content-Type": "application/json"})
        answer = connection.getresponse()
        text = answer.read().decode()
        if answer.status >= 300:
            raise SystemExit(f"{method} {path}: {answer.status} {text[:300]}")
        return text

    def submit(self, count):
        """A batch of jobs that swing one arm out and back; their ids, and how long it took."""
        jobs = [swing(self.jobs + i) for i in range(count)]
        self.jobs += count
        begun = time.time()
        self.call("POST", "/api/v1/batches", {"jobs": jobs, "atomic": True})
        return [job["id"] for job in jobs], time.time() - begun

    def worst_ms(self):
        text = self.call("GET", "/metrics")
        return 1e3 * float(re.search(r'armloom_period_worst_seconds\{loop="control"\} (\S+)', text).group(1))


def swing(number):
    arm, turn = ("left", 0.3) if number % 2 else ("right", -0.3)
    away = [HOME[0] + turn] + HOME[1:]
    points = [{"positions": q, "velocities": [0.0] * 7, "time_from_start": 2.0 * i}
              for i, q in enumerate((HOME, away, HOME))]
    names = [f"{arm}_panda_joint{j}" for j in range(1, 8)]
    return {"id": f"j{number}", "backlog_timeout_s": 100000,
            "trajectory": {"joint_names": names, "points": points}}


def empty_loop(worst_ms, done):
    last = time.monotonic()
    while not done.is_set():
        time.sleep(0.001)
        now = time.monotonic()
        worst_ms.value = max(worst_ms.value, 1e3 * (now - last))
        last = now


def stop_and_resume(server, took, done):
    while not done.is_set():
        begun = time.time()
        server.call("POST", "/api/v1/stop")
        took.append(1e3 * (time.time() - begun))
        server.call("POST", "/api/v1/resume")
        time.sleep(0.01)


def measure(server, waiting, batches):
    begun = time.time()
    while server.jobs < waiting:
        server.submit(min(BATCH, waiting - server.jobs))
    print(f"{waiting} jobs in {time.time() - begun:.2f} s, worst control period {server.worst_ms():.1f} ms")
    worst_ms, beside_done = multiprocessing.Value("d"), multiprocessing.Event()
    beside = multiprocessing.Process(target=empty_loop, args=(worst_ms, beside_done))
    beside.start()
    took, done = [], threading.Event()
    stops = threading.Thread(target=stop_and_resume, args=(server, took, done), daemon=True)
    stops.start()
    for _ in range(batches):
        ids, seconds = server.submit(BATCH)
        print(f"{BATCH} more in {seconds:.2f} s")
        for job in reversed(ids):
            server.call("DELETE", f"/api/v1/jobs/{job}")
    done.set()
    stops.join()
    beside_done.set()
    beside.join()
    took.sort()
    print(f"{len(took)} stops: median {took[len(took) // 2]:.0f}, 99 % {took[int(len(took) * 0.99)]:.0f}, "
          f"most {took[-1]:.0f} ms; worst control period {server.worst_ms():.1f} ms, "
          f"of an empty loop {worst_ms.value:.1f} ms")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("armloom")
    parser.add_argument("--waiting", type=int, default=9000)
    parser.add_argument("--batches", type=int, default=3)
    asked = parser.parse_args()
    server = Server(asked.armloom)
    try:
        measure(server, asked.waiting, asked.batches)
    finally:
        server.process.terminate()
        server.process.wait()


if __name__ == "__main__":
    main()
