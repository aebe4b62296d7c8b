"""`pointfront cluster build -o s3://...`: tiles in a bucket, whatever fails on the way."""

import contextlib
import hashlib
import json
import os
import pathlib
import random
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
from unittest import mock

SUPPORT = pathlib.Path(__file__).resolve().parents[3] / "Testing" / "Support"
sys.path.insert(0, str(SUPPORT))

from bucket_server import HERE, BucketServer  # pylint: disable=wrong-import-position

# pylint: disable=wrong-import-position
from pointfront._bucket import Bucket
from pointfront._errors import PointFrontError
from pointfront._host import TOOL

OPTIONS = ("--tile", "40", "--normals", "pca", "--progress", "none")
COMMAND = (sys.executable, "-B", "-m", "pointfront", "cluster", "build")
PLACE = f"s3://{BucketServer.BUCKET}/countries/land"
STATE = "countries/land/land.pfcollection"


def digests(objects):
    """Tiles and the collection, by their names below the address."""
    return {key.removeprefix("countries/land/"): hashlib.sha256(data).hexdigest()
            for key, data in objects.items() if key.endswith((".pfront", ".pfcollection"))}


class BucketBuild(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.place.name).resolve()
        # Another cluster on this machine may have Dask's usual port, and nobody is told of that.
        cls.usual = socket.socket()
        with contextlib.suppress(OSError):
            cls.usual.bind((HERE, 8787))
            cls.usual.listen()
        cls.inputs = cls.root / "inputs"
        cls.inputs.mkdir()
        for name, seed in (("a", "3"), ("b", "4")):
            cls.tool("generate", "--points", "30000", "-o", cls.inputs / f"{name}.las",
                     "--seed", seed)
        folder = cls.root / "usual/land"
        cls.tool("build", cls.inputs, "-o", folder, "--tiles", *OPTIONS)
        cls.expected = digests({str(file.relative_to(folder)): file.read_bytes()
                                for file in folder.rglob("*.pf*")})
        assert len(cls.expected) > 3

    @classmethod
    def tearDownClass(cls):
        cls.usual.close()
        cls.place.cleanup()

    @staticmethod
    def tool(*arguments, **environment):
        return subprocess.run([str(TOOL), *map(str, arguments)], check=True, capture_output=True,
                              text=True, env={**os.environ, **environment}).stdout

    def setUp(self):
        # Few keys in an answer: a list takes several.
        self.server = self.enterContext(BucketServer(page=5))
        self.environment = {name: value for name, value in os.environ.items()
                            if not name.startswith("AWS_")}
        self.environment |= self.server.environment()
        self.environment |= {"POINTFRONT_CACHE": "off", "TMPDIR": str(self.root)}

    def begun(self, *more, output=PLACE, workers=1, **environment):
        return subprocess.Popen(
            [*COMMAND, str(self.inputs), "-o", output, *OPTIONS, "--local", str(workers), *more],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
            env={**self.environment, **environment})

    def build(self, *more, status=0, workers=1, **environment):
        process = self.begun(*more, workers=workers, **environment)
        out, said = process.communicate(timeout=240)
        self.assertEqual(process.returncode, status, said)
        return out if status == 0 else said

    def puts(self, ending):
        return [key for method, key in self.server.requests
                if method in ("PUT", "POST") and key.endswith(ending)]

    def test_two_workers_give_the_bytes_of_a_folder(self):
        told = json.loads(self.build("--json", workers=2))
        self.assertEqual(told["collection"], f"{PLACE}/land.pfcollection")
        self.assertEqual(digests(self.server.objects), self.expected)
        keys = [key for method, key in self.server.requests if method == "PUT"]
        stores = [place for place, key in enumerate(keys) if key.endswith(".pfront")]
        self.assertGreater(keys.index(STATE), max(stores))  # the state is the last
        self.assertIn("status 0", self.server.objects["countries/land/work/logs/survey-0.log"]
                      .decode())
        info = json.loads(self.tool("info", f"{PLACE}/land.pfcollection", "--json",
                                    **self.environment))
        self.assertEqual(info["points"], told["points_stored"])
        out = self.root / "all.xyz"
        self.tool("export", f"{PLACE}/land.pfcollection", "-o", out, "--force",
                  **self.environment)
        self.assertEqual(len(out.read_text().splitlines()), 1 + told["points_stored"])
        self.assertEqual(list(self.root.glob("pointfront-*")), [])
        # All is done: nothing but the plan's records is written again.
        self.server.requests.clear()
        former = ["tiles/9_-9-0123abcd.pfront", "work/tile-9_-9.json"]
        others = ["tiles/9_9.las", "tiles/9_9-notes.pfront", "work/tile-notes.txt"]
        self.server.objects |= {f"countries/land/{name}": b"{}" for name in former + others}
        self.build()
        self.assertEqual(self.puts(".pfront"), [])
        there = {key.removeprefix("countries/land/") for key in self.server.objects}
        self.assertEqual(there & {*former, *others}, set(others))
        del self.server.objects["countries/land/tiles/9_9-notes.pfront"]
        self.assertEqual(digests(self.server.objects), self.expected)

    def test_the_root_and_keys_that_need_encoding(self):
        """All tiles were built, and then none was found."""
        bucket = BucketServer.BUCKET
        for key, told in (("", f"s3://{bucket}/{bucket}.pfcollection"),
                          ("mit blank", f"s3://{bucket}/mit%20blank/mit%20blank.pfcollection"),
                          ("x%20y", f"s3://{bucket}/x%2520y/x%2520y.pfcollection")):
            with self.subTest(key=key):
                self.server.objects.clear()
                process = self.begun("--json", output=f"s3://{bucket}/{key}")
                out, said = process.communicate(timeout=240)
                self.assertEqual(process.returncode, 0, said)
                self.assertEqual(json.loads(out)["collection"], told)
                before = f"{key}/" if key else ""
                self.assertEqual({name.removeprefix(before) for name in self.server.objects
                                  if name.endswith(".pfront")},
                                 {name for name in self.expected if name.endswith(".pfront")})
                info = json.loads(self.tool("info", told, "--json", **self.environment))
                self.assertEqual(info["points"], 60000)

    def test_other_addresses_are_no_output(self):
        process = self.begun(output="http://localhost:9/land")
        _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 2, said)
        self.assertIn("s3://BUCKET/PREFIX", said)
        self.assertFalse(pathlib.Path("http:").exists())

    def test_a_failed_upload_is_tried_again_or_told(self):
        times = {}

        def weather(method, key):
            times[method, key] = times.get((method, key), 0) + 1
            if method == "PUT" and key.endswith(".pfront") and times[method, key] == 1:
                return 503
            return None

        self.server.before = weather
        self.build()
        self.assertEqual(digests(self.server.objects), self.expected)
        self.server.objects.clear()
        self.server.requests.clear()
        refused = next(name for name in sorted(self.expected) if name.startswith("tiles/"))
        self.server.before = lambda method, key: (
            403 if method == "PUT" and key.endswith(refused) else None)
        said = self.build(status=1)
        self.assertIn(f"cannot write {PLACE}/{refused}", said)
        self.assertIn("AccessDenied", said)
        self.assertIn("the same command goes on", said)
        self.assertEqual(len(said.splitlines()), 1, said)
        self.assertNotIn(STATE, self.server.objects)
        self.assertEqual(set(digests(self.server.objects)),
                         {name for name in self.expected if name.startswith("tiles/")} - {refused})
        self.server.requests.clear()
        self.server.before = lambda method, key: None
        self.build()
        self.assertEqual(self.puts(".pfront"), [f"countries/land/{refused}"])
        self.assertEqual(digests(self.server.objects), self.expected)

    def test_a_large_tile_goes_up_in_parts(self):
        large = self.root / "large.pfront"
        large.write_bytes(random.Random(31).randbytes(20 << 20))
        key = "countries/land/tiles/large.pfront"
        with mock.patch.dict(os.environ, self.environment, clear=True):
            bucket = Bucket(PLACE)
        puts = []

        def weather(method, _):
            if method == "PUT":
                puts.append(method)
            return 503 if len(puts) == 2 and method == "PUT" else None

        self.server.before = weather
        bucket.put(str(large), "tiles/large.pfront")
        self.assertGreater(len(puts), 3)  # two parts at least, and one of them again
        self.assertEqual([made for method, made in self.server.requests if method == "POST"],
                         [key, key])  # begun, and put together
        self.assertEqual(self.server.objects, {key: large.read_bytes()})
        again = self.root / "again.pfront"
        bucket.get("tiles/large.pfront", str(again))
        self.assertEqual(again.read_bytes(), large.read_bytes())
        # A part that cannot be written: no object, and what is there of the upload is given up.
        self.server.objects.clear()
        self.server.before = lambda method, _: 403 if method == "PUT" else None
        with self.assertRaisesRegex(PointFrontError, f"cannot write {PLACE}/tiles/large.pfront"):
            bucket.put(str(large), "tiles/large.pfront")
        self.assertEqual(self.server.objects, {})
        self.assertIn(("DELETE", key), self.server.requests)

    def killed_at(self, ending):
        """A build that is killed, with its workers, when it uploads an object of such a name: the
        object does not come to be."""
        waits = []

        def weather(method, key):
            if method == "PUT" and key.endswith(ending) and "/logs/" not in key:
                waits.append(key)
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(process.pid, signal.SIGKILL)
                return 503
            return None

        self.server.before = weather
        process = self.begun(workers=2)  # the other one is at work, too
        process.communicate(timeout=240)
        self.assertEqual(process.returncode, -signal.SIGKILL)
        time.sleep(0.3)
        self.server.before = lambda method, key: None
        self.server.requests.clear()
        self.assertGreaterEqual(len(waits), 1)
        return waits

    def test_a_kill_between_a_tile_and_its_record(self):
        record = next(name for name in sorted(self.expected) if name.startswith("tiles/"))
        record = "tile-" + record.removeprefix("tiles/").rsplit("-", 1)[0] + ".json"
        self.killed_at(record)
        self.assertNotIn(STATE, self.server.objects)
        self.build()
        self.assertEqual(digests(self.server.objects), self.expected)

    def test_a_kill_between_the_tiles_and_the_state(self):
        self.killed_at(".pfcollection")
        self.assertNotIn(STATE, self.server.objects)
        self.assertEqual(len(list(self.root.glob("pointfront-*"))), 1)
        self.build()
        self.assertEqual(list(self.root.glob("pointfront-*")), [])
        self.assertEqual(self.puts(".pfront"), [])
        self.assertEqual(digests(self.server.objects), self.expected)

    def test_a_kill_between_the_state_and_its_note(self):
        self.killed_at("collection.json")
        self.assertIn(STATE, self.server.objects)
        self.build()
        self.assertEqual(self.puts(".pfront"), [])
        self.assertEqual(digests(self.server.objects), self.expected)
        self.assertIn("countries/land/work/collection.json", self.server.objects)

    def test_a_state_that_somebody_has_changed_is_kept(self):
        self.build()
        self.server.objects[STATE] = b"another one"
        said = self.build(status=1)
        self.assertIn(f"{PLACE}/land.pfcollection: is not as this build left it", said)
        self.assertEqual(self.server.objects[STATE], b"another one")

    def test_words_about_buckets(self):
        for output, words, environment in (
                ("s3://", "no bucket's address", {}),
                ("s3://another/land", "NoSuchBucket", {}),
                (PLACE, "there are no keys", {"AWS_ACCESS_KEY_ID": "", "HOME": "/nonexistent",
                                              "AWS_SECRET_ACCESS_KEY": ""}),
                (PLACE, "Forbidden", {"AWS_SECRET_ACCESS_KEY": "another"})):
            with self.subTest(words=words):
                process = self.begun(output=output, **environment)
                _, said = process.communicate(timeout=120)
                self.assertEqual(process.returncode, 1, said)
                self.assertIn(words, said)
                self.assertEqual(len(said.splitlines()), 1, said)
        self.assertIn("--decode once keeps", self.build("--decode", "once", status=1))
        self.assertEqual(self.server.objects, {})


if __name__ == "__main__":
    unittest.main()
