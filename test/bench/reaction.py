#!/usr/bin/env python3
"""Time from the beginning of a monitor period to its stop commands, in real time on a busy machine.

    test/bench/reaction.py ARMLOOM [--stops 1000] [--subscribers 200] [--busy 2] [--minutes 10]

Two Pandas move all the time. Noise on the measured positions of each arm (a fault of 20 ms) makes the monitor stop it
before it is resumed, again and again. Meanwhile half of the subscribers read all events over WebSockets and half over server-sent events, and busy
processes load the cores. Figures are the server's own metrics: quantiles are the upper limits of histogram buckets.
Exit code 1 if there were too few stops, a job failed, a subscriber was lost, or 99.9 % of the stops took more than two periods.
"""
import argparse
import json
import multiprocessing
import re
import select
import subprocess
import sys
import threading
import time
import urllib.error

from latency import Events
from loaded_server import API, EmptyLoop, LoadedServer, connect, shake_hands, swing

REACTION, LATE = "armloom_monitor_reaction_seconds", "armloom_monitor_late_seconds"
OVERRUNS = 'armloom_overruns_total{loop="control"}'
PERIOD_S = 0.01  # of config/two_pandas.json
# Two periods; over before the arm rests. No motion of the arm: after a real deviation its next limit would be larger.
FAULT = {"kind": "noise", "value": 0.003, "for_s": 2 * PERIOD_S}
PONG = b"\x8a\x80\0\0\0\0"
PONG_EVERY_S = 5
MOVES_S = 0.1  # before a fault


def read_events(port, count, done, answer):
    """Reads event streams in a process of its own. Answers with the bytes read from each, and the lost streams."""
    web_sockets, took = shake_hands(port, count - count // 2)
    streams, lost = [connect(port) for _ in range(count // 2)], took.count(None)
    for s in streams:
        s.sendall(f"GET {API}/events HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n".encode())
    by_fd = {s.fileno(): s for s in web_sockets + streams}
    epoll, read, buffer = select.epoll(), dict.fromkeys(by_fd, 0), bytearray(1 << 16)
    for s in by_fd.values():
        s.setblocking(False)
        epoll.register(s.fileno(), select.EPOLLIN)
    alive_at = time.monotonic()
    while not done.is_set():
        for fd, _ in epoll.poll(0.1):
            size = by_fd[fd].recv_into(buffer)
            read[fd] += size
            if size == 0:
                epoll.unregister(fd)
                lost += 1
        if time.monotonic() - alive_at < PONG_EVERY_S:
            continue
        alive_at = time.monotonic()
        for s in web_sockets:
            s.send(PONG)
    answer.put((sorted(read.values()), lost))


class Arm(threading.Thread):
    """Makes the monitor stop one arm again and again, until `over` is set."""

    def __init__(self, server, name, over):
        super().__init__(daemon=True)
        self.server, self.name, self.over = server, name, over
        self.failed = 0
        self.events = Events(server.port)
        self.start()

    def call(self, method, path, body=None):
        try:
            return self.server.call(method, API + path, body)
        except urllib.error.HTTPError as error:
            print(f"{method} {path}: {error.read().decode()}", file=sys.stderr)
            raise

    def run(self):
        while not self.over.is_set():
            job = f"{self.name}-{time.monotonic_ns()}"
            self.call("POST", "/jobs", {**swing(job, self.name, 6, []), "move_to_start": "plan"})
            if (result := self.follow(job))["reason"] != "completed":
                self.failed += 1
                print(job, result, file=sys.stderr)
                self.call("POST", f"/arms/{self.name}/resume")

    def follow(self, job):
        """Injects a fault whenever the job runs. Returns the job's result."""
        state = None
        while True:
            event = self.events.next()
            if event["type"] != "job" or event["data"]["id"] != job:
                continue
            before, state = state, event["data"]["state"]
            if event["data"]["result"]:
                return event["data"]["result"]
            if any(wait["kind"] == "stop" for wait in event["data"]["waits_on"]):
                self.call("POST", f"/arms/{self.name}/resume")
            elif state == "running" != before and not self.over.is_set():
                time.sleep(MOVES_S)
                self.call("POST", "/sim/faults", {"arm": self.name, **FAULT})


def counts(figures, name):
    """Returns the cumulative counts of a histogram by the upper limits of its buckets (s)."""
    found = ((re.fullmatch(name + r'_bucket\{le="(.*)"\}', key), value) for key, value in figures.items())
    return {float(key[1]): value for key, value in found if key}


def quantiles(before, after, name):
    """"50 % 0.5, 99 % 2, 99.9 % 10 ms of 1000", and the last of them in s."""
    base = counts(before, name)
    cumulative = sorted((edge, value - base[edge]) for edge, value in counts(after, name).items())
    total = cumulative[-1][1]
    at = {share: next(edge for edge, count in cumulative if count >= share * total) for share in (0.5, 0.99, 0.999)}
    text = ", ".join(f"{100 * share:g} % {1e3 * edge:g}" for share, edge in at.items())
    return f"{text} ms of {total:.0f}", at[0.999]


def measure(server, asked):
    done, answer, empty = multiprocessing.Event(), multiprocessing.Queue(), EmptyLoop()
    readers = multiprocessing.Process(target=read_events, args=(server.port, asked.subscribers, done, answer))
    readers.start()
    time.sleep(2)
    before, begun, over = server.metrics(), time.monotonic(), threading.Event()
    arms = [Arm(server, name, over) for name in ("left", "right")]
    stops = lambda figures: figures[REACTION + "_count"] - before[REACTION + "_count"]
    while (is_running := all(arm.is_alive() for arm in arms)) and stops(server.metrics()) < asked.stops:
        if time.monotonic() - begun > 60 * asked.minutes:
            break
        time.sleep(1)
    over.set()
    for arm in arms:
        arm.join(60 if is_running else 0)
    after, lasted = server.metrics(), time.monotonic() - begun
    done.set()
    read, lost = answer.get()
    readers.join()
    gaps, longest_ms = empty.end()
    reaction, slowest = quantiles(before, after, REACTION)
    change = lambda name: after[name] - before[name]
    failed = sum(arm.failed for arm in arms)
    print(f"monitor period {1e3 * PERIOD_S:g} ms; {stops(after):.0f} stops in {lasted:.0f} s, "
          f"{failed} jobs did not succeed")
    print(f"reaction: {reaction}, longest {1e3 * after['armloom_monitor_reaction_worst_seconds']:.2f} ms")
    print(f"periods begin late by: {quantiles(before, after, LATE)[0]}; "
          f"{change('armloom_monitor_missed_periods_total'):.0f} missed; control overruns "
          f"{change(OVERRUNS):.0f} (an empty loop: {gaps}, longest gap {longest_ms:.1f} ms)")
    print(f"{len(read)} subscribers, {lost} lost; each read {read[0] / lasted / 1024:.1f} to "
          f"{read[-1] / lasted / 1024:.1f} KiB/s; {change('armloom_frames_dropped_total'):.0f} frames dropped")
    return stops(after) >= asked.stops and failed == 0 and lost == 0 and slowest <= 2 * PERIOD_S


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("armloom")
    parser.add_argument("--stops", type=int, default=1000)
    parser.add_argument("--subscribers", type=int, default=200)
    parser.add_argument("--busy", type=int, default=multiprocessing.cpu_count())
    parser.add_argument("--minutes", type=float, default=10)
    asked = parser.parse_args()
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(asked.busy)]
    try:
        with LoadedServer(asked.armloom) as server:
            holds = measure(server, asked)
    finally:
        for process in busy:
            process.terminate()
            process.wait()
    sys.exit(0 if holds else 1)


if __name__ == "__main__":
    main()
