#!/usr/bin/env python3
"""Delay of the control loop and duration of POST /stop while batches are submitted.

    test/bench/control_gap.py ARMLOOM [--waiting 9000] [--batches 3] [--readers 0]

Fills the queue of two Pandas with batches of 1,000 jobs. Then submits more batches and cancels their jobs one
by one, while another client continuously stops and resumes all arms, and readers continuously request every
list. Gaps are the server's own metrics of its control period (/metrics), next to the longest gap of an empty loop.
"""
import argparse
import http.client
import multiprocessing
import time

from loaded_server import API, EmptyLoop, LoadedServer, quantiles

BATCH = 1000


def worst_ms(server):
    return 1e3 * server.metrics()['armloom_period_worst_seconds{loop="control"}']


def overruns(server):
    return server.metrics()['armloom_overruns_total{loop="control"}']


def stop_and_resume(server, done, answer):
    """Repeats stop and resume in a separate process. A thread here would wait for the thread that writes batches.

    The first request is no stop and is not measured: it takes about 30 ms, because the memory of the process is copied.
    """
    server.call("GET", "/healthz")
    took_s = []
    while not done.is_set():
        begun = time.time()
        server.call("POST", API + "/stop")
        took_s.append(time.time() - begun)
        server.call("POST", API + "/resume")
        time.sleep(0.01)
    answer.put(took_s)


def read_lists(port, job, done):
    """Requests every list in turn. Of the event stream only the snapshot at its beginning is read."""
    paths = ["/queue", "/jobs", "/timeline", "/arms", f"/jobs/{job}", "/events"]
    while not done.is_set():
        for path in paths:
            connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
            connection.request("GET", API + path)
            answer = connection.getresponse()
            if path == "/events":
                while answer.readline() not in (b"\n", b"\r\n", b""):
                    pass
            else:
                answer.read()
            connection.close()


def measure(server, waiting, batches, readers):
    begun = time.time()
    server.submit(waiting)
    print(f"{waiting} jobs in {time.time() - begun:.2f} s, worst control period {worst_ms(server):.1f} ms")
    done, answer, empty = multiprocessing.Event(), multiprocessing.Queue(), EmptyLoop()
    before = overruns(server)
    multiprocessing.Process(target=stop_and_resume, args=(server, done, answer), daemon=True).start()
    for _ in range(readers):
        multiprocessing.Process(target=read_lists, args=(server.port, "j0", done), daemon=True).start()
    for n in range(batches):
        begun = time.time()
        ids = server.submit(BATCH, f"more{n}-")
        print(f"{BATCH} more in {time.time() - begun:.2f} s")
        for job in reversed(ids):
            server.call("DELETE", f"{API}/jobs/{job}")
    done.set()
    print(f"stops: {quantiles(answer.get())}; worst control period {worst_ms(server):.1f} ms, "
          f"of an empty loop {empty.end()[1]:.1f} ms; "
          f"{overruns(server) - before:.0f} control overruns")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("armloom")
    parser.add_argument("--waiting", type=int, default=9000)
    parser.add_argument("--batches", type=int, default=3)
    parser.add_argument("--readers", type=int, default=0)
    asked = parser.parse_args()
    with LoadedServer(asked.armloom, "--jobs-per-second", 100000) as server:
        measure(server, asked.waiting, asked.batches, asked.readers)


if __name__ == "__main__":
    main()
