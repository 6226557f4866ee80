"""Simulates the effect of a power cut on a server's data folder."""
import os
import shutil

SECTOR = 512


class SyncedCopy:
    """A copy of each file as of its last sync, kept by a library preloaded into the server."""

    def __init__(self, library, data):
        self.library, self.data = library, data
        self.copy = data.with_name(data.name + "-synced")

    def environment(self, nth):
        """Returns the environment of a server that ends instead of its nth sync. Existing files are taken as synced."""
        shutil.rmtree(self.copy, ignore_errors=True)
        self.data.mkdir(exist_ok=True)
        shutil.copytree(self.data, self.copy)
        return {"LD_PRELOAD": str(self.library), "ARMLOOM_SYNCED_OF": str(self.data.resolve()),
                "ARMLOOM_SYNCED_TO": str(self.copy), "ARMLOOM_CUT_AT": str(nth)}

    def cut(self, rng):
        """Reduces the folder to what survives: synced data, and none, some or most of the other sectors."""
        share = rng.choice([0.0, 0.0, 0.1, 0.5, 0.9])
        for name in {*files_of(self.data), *files_of(self.copy)}:
            left = survivors(content(self.data / name), content(self.copy / name), share, rng)
            if left is None:
                (self.data / name).unlink(missing_ok=True)
            else:
                (self.data / name).parent.mkdir(parents=True, exist_ok=True)
                (self.data / name).write_bytes(left)


def files_of(folder):
    return (path.relative_to(folder) for path in folder.rglob("*") if path.is_file())


def content(file):
    return file.read_bytes() if file.exists() else None


def survivors(now, synced, share, rng):
    """`share`: probability that an unsynced sector, creation or removal is on disk nevertheless."""
    if (now is None) != (synced is None) and (rng.random() < share) == (now is None):
        return None
    if now is None:
        return synced
    size = len(now if rng.random() < share else synced or b"")
    now, synced = ((text or b"")[:size].ljust(size, b"\0") for text in (now, synced))
    return b"".join((now if rng.random() < share else synced)[at:at + SECTOR] for at in range(0, size, SECTOR))
