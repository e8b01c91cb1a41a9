"""The programs that are compared, each a process of its own with one thread, asked over pipes (wire.py)."""
import json
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "NUMBA_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS")}


class Program:
    def __init__(self, name, command):
        self.name, self.command, self.process = name, command, None
        self.start()
        about = self.ask({"do": "overhead"})
        self.version, self.overhead = about["version"], about["seconds"]

    def start(self):
        folder = HERE.parents[1] / "build" / "peers"
        folder.mkdir(parents=True, exist_ok=True)
        with open(folder / f"{self.name}.log", "w") as log:
            self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=log, text=True,
                                            env={**os.environ, **ONE_THREAD}, cwd=folder)

    def ask(self, request):
        """The answer; {"error": ...} where the program could not, or died (it is then restarted)."""
        try:
            self.process.stdin.write(json.dumps(request) + "\n")
            self.process.stdin.flush()
            line = self.process.stdout.readline()
        except BrokenPipeError:
            line = ""
        if not line:
            code = self.process.wait()
            self.start()
            return {"error": f"the program ended with status {code}"}
        return json.loads(line)

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def start(ours):
    """All four; `ours` is the path of the engine's program."""
    def python(file):
        return [sys.executable, str(HERE / file)]
    return {
        "superhelix": Program("superhelix", [ours, "--serve"]),
        "pyPBD": Program("pyPBD", python("pypbd_rod.py")),
        "MuJoCo": Program("MuJoCo", python("mujoco_rod.py")),
        "PyElastica": Program("PyElastica", python("pyelastica_rod.py")),
    }
