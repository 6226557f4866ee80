#!/usr/bin/env python3
"""A scene that a camera writes: boxes in bulk, and single changes at a steady rate while both arms move.

    test/bench/camera.py ARMLOOM [single bulk rate memory]

Measures all cases, or the named ones. Client and server share the machine.
"""
import argparse
import http.client
import json
import random
import threading
import time

from loaded_server import API, LoadedServer, Periods, quantiles

SCENE = API + "/scene"


def boxes(count, sizes=1, seed=1):
    """Boxes around both Pandas, at least 0.55 m from their bases. `sizes`: number of different sizes."""
    random.seed(seed)
    found = []
    while len(found) < count:
        x, y, z = (random.uniform(*limits) for limits in ((-1, 1), (-1, 1), (0.13, 1.2)))
        if min(((x - base) ** 2 + y * y) ** 0.5 for base in (-0.4, 0.4)) < 0.55:
            continue
        side = 0.04 - 0.02 * (len(found) % sizes) / sizes
        found.append({"name": f"v{len(found)}", "box": [side] * 3, "xyz": [x, y, z]})
    return found


class Client:
    """One connection that is kept open."""

    def __init__(self, server):
        self.connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=60)

    def call(self, method, path, body=None, text=None):
        """Returns the seconds that the request took; fails unless it succeeds."""
        text = text or (json.dumps(body) if body is not None else None)
        begun = time.monotonic()
        self.connection.request(method, path, text, {"Content-Type": "application/json"} if text else {})
        answer = self.connection.getresponse()
        said = answer.read()
        took = time.monotonic() - begun
        if answer.status not in (200, 201):
            raise SystemExit(f"{method} {path}: {answer.status} {said[:300]}")
        return took

    def fill(self, count):
        return self.call("PUT", SCENE, {"objects": boxes(count)})

    def move_box(self, number):
        """Moves a box above the table, between and in front of the arms."""
        place = [0.3 * ((number % 7) / 7 - 0.5), 0.9, 0.3 + 0.001 * (number % 11)]
        return self.call("PUT", f"{SCENE}/objects/seen", {"box": [0.04] * 3, "xyz": place})


def single(armloom):
    """PUT of one box beside others, arms at rest."""
    for count in (0, 500, 2000):
        with LoadedServer(armloom) as server:
            client = Client(server)
            client.fill(count)
            took = [client.move_box(i) for i in range(200)]
            print(f"PUT of one box beside {count}: {quantiles(took)}")


def bulk(armloom):
    """2,000 boxes in one request, arms at rest."""
    for sizes in (1, 2000):
        with LoadedServer(armloom) as server:
            client = Client(server)
            texts = [json.dumps({"objects": boxes(2000, sizes, seed)}) for seed in range(1, 11)]
            took = [client.call("PUT", SCENE, text=text) for text in texts]
            cleared = client.call("DELETE", SCENE + "/objects")
            print(f"PUT /scene of 2,000 boxes ({len(texts[0]) // 1024} KiB) of {sizes} sizes: first "
                  f"{1e3 * took[0]:.0f} ms, {quantiles(took)}; DELETE /scene/objects {1e3 * cleared:.0f} ms")


def rate(armloom, changes=150, seconds=10):
    """Single changes at a steady rate while both arms move, on four connections."""
    for count in (0, 500, 2000):
        with LoadedServer(armloom, "--requests-per-second", 100000, demo=True) as server:
            Client(server).fill(count)
            time.sleep(3)
            numbers, took, lock = iter(range(changes * seconds)), [], threading.Lock()
            before = server.metrics()
            periods = Periods(server)
            begun = time.monotonic()

            def send():
                client = Client(server)
                while True:
                    with lock:
                        number = next(numbers, None)
                    if number is None:
                        return
                    time.sleep(max(0.0, begun + number / changes - time.monotonic()))
                    took.append(client.move_box(number))

            threads = [threading.Thread(target=send) for _ in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            lasted = time.monotonic() - begun
            p99, overruns = periods.since()
            ended = sum(value - before.get(name, 0) for name, value in server.metrics().items()
                        if name.startswith("armloom_jobs_total") and "succeeded" in name)
            print(f"{len(took) / lasted:.0f} changes a second beside {count} boxes for {lasted:.1f} s: {quantiles(took)}; "
                  f"control 99 % {p99:.2f} ms, {overruns}; {ended:.0f} jobs succeeded meanwhile")


def memory(armloom):
    """Resident memory before, with, and after 2,000 boxes of different sizes, ten times."""
    with LoadedServer(armloom) as server:
        client = Client(server)
        said = [f"{server.memory_mib():.0f} MiB at start"]
        for seed in range(1, 11):
            client.call("PUT", SCENE, {"objects": boxes(2000, 2000, seed)})
        said.append(f"{server.memory_mib():.0f} with 2,000 boxes, set ten times")
        client.call("DELETE", SCENE + "/objects")
        time.sleep(1)
        said.append(f"{server.memory_mib():.0f} after DELETE /scene/objects")
        print("resident memory: " + ", ".join(said))


CASES = [single, bulk, rate, memory]

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("armloom")
    parser.add_argument("cases", nargs="*", choices=[[], *(case.__name__ for case in CASES)])
    options = parser.parse_args()
    for case in CASES:
        if not options.cases or case.__name__ in options.cases:
            case(options.armloom)
