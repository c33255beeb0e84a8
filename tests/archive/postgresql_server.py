"""A server of PostgreSQL for trials, on a socket in a folder of its own, without a network."""

import os
import pathlib
import shutil
import signal
import subprocess
import time

PROGRAMS = pathlib.Path("/usr/lib/postgresql/15/bin")
ABSENT = "postgresql-15 is not installed: no trial on a server"


class Server:
    """with Server(folder) as server: it runs where Debian's package is there."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.process = None
        self.databases = 0
        self.runs = (PROGRAMS / "postgres").exists()
        self.as_user = ["setpriv", "--reuid=postgres", "--regid=postgres", "--clear-groups"] if os.geteuid() == 0 else []

    def __enter__(self):
        if self.runs:
            if self.as_user:
                shutil.chown(self.folder, "postgres")
            self.run("initdb", "-D", self.data, "-U", "keeper", "-A", "trust", "-E", "UTF8", "--locale=C", "--no-sync")
            self.start()
        return self

    def __exit__(self, *_):
        if self.runs:
            self.process.send_signal(signal.SIGQUIT)
            self.process.wait()

    def new_database(self):
        """Address of an empty database."""
        self.databases += 1
        self.run("createdb", "-h", self.folder, "-U", "keeper", f"archive_{self.databases}")
        return f"postgresql://keeper@/archive_{self.databases}?host={self.folder}"

    @property
    def data(self):
        return self.folder / "data"

    def run(self, program, *words):
        subprocess.run([*self.as_user, PROGRAMS / program, *words], check=True, stdout=subprocess.DEVNULL, cwd=self.folder)

    def start(self):
        """Starts it, and waits until it answers; where it was killed, it recovers first."""
        with open(self.folder / "log", "ab") as log:
            self.process = subprocess.Popen([*self.as_user, PROGRAMS / "postgres", "-D", self.data, "-k", self.folder, "-c", "listen_addresses=",
                                             "-c", "max_connections=200"], stdout=log, stderr=log, cwd=self.folder)
        for _ in range(6000):
            if subprocess.run([PROGRAMS / "pg_isready", "-q", "-h", self.folder], check=False).returncode == 0:
                return
            if self.process.poll() is not None:
                break
            time.sleep(0.02)
        raise SystemExit("the server does not start:\n" + (self.folder / "log").read_text()[-2000:])

    def kill(self):
        """Ends the server and each of its processes by SIGKILL."""
        self.process.send_signal(signal.SIGSTOP)  # no new ones from here on
        children = children_of(self.process.pid)
        for child in children:
            try:
                os.kill(child, signal.SIGKILL)
            except ProcessLookupError:
                pass
        self.process.kill()
        self.process.wait()
        while any(is_alive(child) for child in children):  # it does not start beside one of them
            time.sleep(0.01)


def status_of(process):
    """State and parent of a process; nothing where it is gone."""
    try:
        return pathlib.Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[:2]
    except (FileNotFoundError, ProcessLookupError):
        return None


def is_alive(process):
    status = status_of(process)
    return status is not None and status[0] != "Z"


def children_of(parent):
    return [int(entry.name) for entry in pathlib.Path("/proc").iterdir()
            if entry.name.isdigit() and (status := status_of(entry.name)) and int(status[1]) == parent]
