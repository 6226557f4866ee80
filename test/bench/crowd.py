#!/usr/bin/env python3
"""The server under load from many clients: measures all cases below, or the named ones.

    test/bench/crowd.py ARMLOOM [handshakes slow_readers bodies queue durable_jobs readers stalled connections
                                 slow_clients restart memory]

Client and server share the machine. Times are of complete requests on separate connections.
"""
import argparse
import re
import resource
import select
import shutil
import sqlite3
import subprocess
import tempfile
import threading
import time
import zlib

from loaded_server import (API, TOP, LoadedServer, Periods, Repeated, connect, quantiles, shake_hands, swing)


def handshakes(armloom):
    """Opens many WebSockets at once. Prints how many are lost, and how long other clients wait."""
    for count in (2300, 3400):
        with LoadedServer(armloom, demo=True) as server:
            time.sleep(1)
            others = Repeated(server.port, "GET", "/healthz", "127.0.0.2")
            sockets, took = shake_hands(server.port, count)
            lost = took.count(None)
            print(f"{count} WebSockets at once: open after {quantiles([t for t in took if t])}, {lost} lost")
            time.sleep(2)
            print(f"  /healthz of others: {quantiles(others.end())}")
            for s in sockets:
                s.close()


def slow_readers(armloom):
    """1,000 clients request the dashboard's largest script and do not read it."""
    script = max((TOP / "web/dist/assets").glob("*.js"), key=lambda f: f.stat().st_size)
    with LoadedServer(armloom) as server:
        before = server.memory_mib()
        ask = f"GET /assets/{script.name} HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\n\r\n".encode()
        sockets = [connect(server.port, receive_buffer=4096) for _ in range(1000)]
        for s in sockets:
            s.sendall(ask)
        time.sleep(2)
        print(f"1,000 slow readers of {script.stat().st_size // 1024} KiB: {before:.0f} MiB before, "
              f"{server.memory_mib():.0f} with them", end="")
        for s in sockets:
            s.close()
        time.sleep(1)
        print(f", {server.memory_mib():.0f} after, {server.memory_mib('VmHWM'):.0f} at most")


def bodies(armloom):
    """Sends 200 bodies of 8 MiB without their last byte."""
    size = 8 * 1024 * 1024
    with LoadedServer(armloom) as server:
        before = server.memory_mib()
        head = (f"POST {API}/jobs HTTP/1.1\r\nHost: 127.0.0.1:{server.port}\r\nContent-Type: application/json\r\n"
                f"Content-Length: {size}\r\n\r\n").encode()
        sockets, refused = [], 0
        for _ in range(200):
            s = connect(server.port)
            sockets.append(s)
            try:
                s.sendall(head + b" " * (size - 1))
            except OSError:
                pass
        for s in sockets:
            if select.select([s], [], [], 0)[0]:
                refused += b" 503 " in s.recv(64)
        begun = time.monotonic()
        server.call("POST", API + "/stop")
        print(f"200 unfinished bodies of 8 MiB: {before:.0f} MiB before, {server.memory_mib('VmHWM'):.0f} at most; "
              f"{refused} refused with 503, a stop beside the others took {1e3 * (time.monotonic() - begun):.1f} ms")


def queue(armloom):
    """wrk: GET /queue as fast as possible while both arms move."""
    with LoadedServer(armloom, "--requests-per-second", 1000000, demo=True) as server:
        time.sleep(2)
        control, monitor = Periods(server), Periods(server, "monitor")
        said = subprocess.run(["wrk", "-t1", "-c8", "-d10", "--latency", f"http://127.0.0.1:{server.port}{API}/queue"],
                              capture_output=True, text=True, check=True).stdout
        rate = re.search(r"Requests/sec:\s+(\S+)", said)[1]
        p99 = re.search(r"99%\s+(\S+)", said)[1]
        print(f"GET /queue while both arms move, 8 connections: {rate} a second, 99 % {p99}; "
              f"{control.since()[1]}, {monitor.since()[1]}")


def durable_jobs(armloom, rate=300, seconds=20):
    """POST /jobs at a steady rate with --data, on eight connections, while arms move."""
    folder = tempfile.mkdtemp(prefix="armloom-crowd-", dir="/var/tmp")
    with LoadedServer(armloom, "--data", folder) as server:
        numbers, took, lock = iter(range(rate * seconds)), [], threading.Lock()
        begun = time.monotonic()

        def post():
            while True:
                with lock:
                    number = next(numbers, None)
                if number is None:
                    return
                time.sleep(max(0.0, begun + number / rate - time.monotonic()))
                start = time.monotonic()
                server.call("POST", API + "/jobs", swing(f"d{number}", ("left", "right")[number % 2], 2, []))
                took.append(time.monotonic() - start)

        threads = [threading.Thread(target=post) for _ in range(8)]
        control = Periods(server)
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        lasted = time.monotonic() - begun
        p99, overruns = control.since()
        print(f"{len(took)} durable jobs in {lasted:.1f} s: {len(took) / lasted:.0f} a second (asked for {rate}), "
              f"each {quantiles(took)}; control 99 % {p99:.2f} ms, {overruns}")
    shutil.rmtree(folder)


def read_poses(server, count, seconds):
    """Measures the poses per second that each of many WebSockets gets."""
    sockets, took = shake_hands(server.port, count)
    by_fd = {s.fileno(): s for s in sockets}
    epoll, frames, buffer = select.epoll(), dict.fromkeys(by_fd, 0), bytearray(1 << 16)
    for s in sockets:
        s.setblocking(False)
        epoll.register(s.fileno(), select.EPOLLIN)
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for fd, _ in epoll.poll(0.1):
            frames[fd] += buffer.count(b'"type":"state"', 0, by_fd[fd].recv_into(buffer))
    return sorted(n / seconds for n in frames.values()), took.count(None)


def readers(armloom, count=2000):
    """WebSockets read all events while both arms move, first with two long jobs, then with the demo's many short jobs."""
    for demo in (False, True):
        with LoadedServer(armloom, demo=demo) as server:
            if not demo:
                for arm in ("left", "right"):
                    server.call("POST", API + "/jobs", swing(arm, arm, 60, []))
            time.sleep(2)
            control = Periods(server)
            rates, lost = read_poses(server, count, 10)
            p99, overruns = control.since()
            print(f"{count} readers of {'the demo, 20 events a second' if demo else 'two long motions'} ({lost} lost): "
                  f"poses a second: median {rates[len(rates) // 2]:.1f}, least {rates[0]:.1f}; control 99 % {p99:.2f} "
                  f"ms, {overruns}; {server.memory_mib():.0f} MiB")


def stalled(armloom, seconds=20):
    """Compares the control period with and without 200 stalled readers, three times in one run."""
    with LoadedServer(armloom, demo=True) as server:
        time.sleep(2)
        seen = {0: [], 200: []}
        for _ in range(3):
            for count in seen:
                sockets, _ = shake_hands(server.port, count, receive_buffer=4096)
                control = Periods(server)
                time.sleep(seconds / 2)
                seen[count].append(control.since()[0])
                for s in sockets:
                    s.close()
        alone, beside = (sorted(seen[count])[1] for count in (0, 200))
        print(f"control period, 99 %, medians of 3: {alone:.3f} ms alone, {beside:.3f} beside 200 stalled readers "
              f"({100 * (beside / alone - 1):+.1f} %)")


def connections(armloom):
    """10,000 connections from one address send half a header; another address sends stops."""
    with LoadedServer(armloom, demo=True) as server:
        time.sleep(1)
        stops = Repeated(server.port, "POST", API + "/stop", "127.0.0.2")
        sockets = []
        for i in range(10000):
            s = connect(server.port, wait=False)
            sockets.append(s)
            if i % 200 == 0:
                time.sleep(0.02)
        time.sleep(1)
        held = 0
        for s in sockets:
            try:
                held += s.send(b"GET /api/v1/queue HTTP/1.1\r\nX-Slow: ") > 0
            except OSError:
                pass
        time.sleep(5)
        took = stops.end()
        print(f"10,000 connections with half a header ({held} could send it): POST /stop of others {quantiles(took)}; "
              f"{server.memory_mib():.0f} MiB")


def slow_clients(armloom):
    """slowhttptest: 3,000 connections send a header, then a body, byte by byte."""
    for kind, how in (("headers", "-H"), ("bodies", "-B")):
        with LoadedServer(armloom, demo=True) as server:
            time.sleep(1)
            stops = Repeated(server.port, "POST", API + "/stop", "127.0.0.2")
            subprocess.run(["slowhttptest", how, "-c", "3000", "-r", "1500", "-i", "2", "-l", "15", "-p", "2", "-u",
                            f"http://127.0.0.1:{server.port}{API}/jobs"], stdout=subprocess.DEVNULL, check=True)
            print(f"slowhttptest, 3,000 connections with slow {kind}: POST /stop of others {quantiles(stops.end())}")


def checksum(*values):
    """Returns the checksum that the server stores with a row."""
    types = {int: b"1", str: b"3", type(None): b"5"}
    return zlib.crc32(b"".join(types[type(v)] + (b"" if v is None else str(v).encode()) for v in values))


def stored_jobs(armloom, folder, ended, waiting):
    """Makes a data folder like that of a long-running server: copies the rows of some jobs many times."""
    with LoadedServer(armloom, "--data", folder) as server:
        server.call("POST", API + "/stop")
        server.submit(1, "w")
        server.submit(1, "e")
        server.call("DELETE", API + "/jobs/e0")
    base = sqlite3.connect(f"{folder}/armloom.db")
    base.create_function("checksum", -1, checksum)
    of_job = [row[1] for row in base.execute("PRAGMA table_info(job)") if row[1] != "sum"]
    columns = of_job[2:]
    ids = dict(base.execute("SELECT id, number FROM job"))

    def copy(of, numbers):
        for number in numbers:
            name = f"copy-{number}"
            base.execute(
                f"INSERT INTO job(number, id, {', '.join(columns)}) SELECT ?, ?, {', '.join(columns)} FROM job "
                "WHERE number = ?", (number, name, ids[of]))
            base.execute("UPDATE job SET view = replace(view, ?, ?) WHERE number = ?",
                         (f'"{of}"', f'"{name}"', number))
            base.execute("INSERT INTO body(number, text) SELECT ?, replace(text, ?, ?) FROM body WHERE number = ?",
                         (number, f'"{of}"', f'"{name}"', ids[of]))
    first = max(ids.values()) + 1
    copy("e0", range(first, first + ended))
    copy("w0", range(first + ended, first + ended + waiting))
    # Same order as kSumOfJob and kSumOfBody (server/store/tables.h).
    base.execute(f"UPDATE job SET sum = checksum({', '.join(of_job)})")
    base.execute("UPDATE body SET sum = checksum(number, text, amended)")
    base.commit()
    base.close()


def restart(armloom):
    """Measures the time from process start to /readyz, with 100,000 jobs on disk."""
    for waiting in (0, 1000, 9000):
        folder = tempfile.mkdtemp(prefix="armloom-crowd-", dir="/var/tmp")
        stored_jobs(armloom, folder, 100000 - waiting, waiting)
        begun = time.monotonic()
        with LoadedServer(armloom, "--data", folder, "--keep-jobs", 200000) as server:
            while True:
                try:
                    server.call("GET", "/readyz")
                    break
                except OSError:
                    time.sleep(0.005)
            ready = time.monotonic() - begun
            while True:  # until all waiting jobs are back
                queued = server.metrics().get('armloom_jobs{state="queued"}', 0)
                if queued >= waiting:
                    break
                time.sleep(0.01)
            print(f"100,000 stored jobs, of which {waiting} wait: ready after {ready:.2f} s, all that waits is back "
                  f"after {time.monotonic() - begun:.2f} s; {server.memory_mib():.0f} MiB")
        shutil.rmtree(folder)


def memory(armloom, minutes=5, speed=100):
    """Measures memory during a long run of the demo load, and its slope in the second half."""
    with LoadedServer(armloom, "--speed", speed, demo=True) as server:
        samples, begun = [], time.monotonic()
        while (t := time.monotonic() - begun) < 60 * minutes:
            samples.append((t * speed / 3600, server.memory_mib()))
            time.sleep(2)
        half = samples[len(samples) // 2:]
        n = len(half)
        mean_t, mean_m = sum(t for t, _ in half) / n, sum(m for _, m in half) / n
        slope = sum((t - mean_t) * (m - mean_m) for t, m in half) / sum((t - mean_t) ** 2 for t, _ in half)
        ended = sum(v for k, v in server.metrics().items() if k.startswith("armloom_jobs_total"))
        shown = ", ".join(f"{m:.1f} after {t:.1f} h" for t, m in samples[:: max(1, len(samples) // 5)])
        print(f"demo load at speed {speed}, {ended:.0f} jobs: {shown}; slope of the second half {slope:+.2f} MiB an "
              f"hour of cell time")


def main():
    figures = [handshakes, slow_readers, bodies, queue, durable_jobs, readers, stalled, connections, slow_clients, restart,
               memory]
    by_name = {figure.__name__: figure for figure in figures}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("armloom")
    parser.add_argument("names", nargs="*", choices=[[], *by_name])
    asked = parser.parse_args()
    most = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (most, most))
    for name in asked.names or by_name:
        by_name[name](asked.armloom)


if __name__ == "__main__":
    main()
