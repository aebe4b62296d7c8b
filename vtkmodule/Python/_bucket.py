"""A bucket as the output of `pointfront cluster build`: `s3://BUCKET/PREFIX`."""

import contextlib
import fcntl
import glob
import json
import os
import re
import shutil
import tempfile
import threading
import time
import urllib.parse
from concurrent.futures import ThreadPoolExecutor

from ._errors import PointFrontError

AT_ONCE = 16  # downloads of small objects
TRIES = 5  # for each request
# Objects that builds of tiles name; others may keep theirs beside them.
OWN = re.compile(r"tiles/-?\d+_-?\d+-[0-9a-f]{8}\.pfront|work/tile--?\d+_-?\d+\.json")
IN_USE = "in-use"  # a file of a workplace that its process keeps locked

_lock = threading.Lock()
_known = {}  # workplaces by address and run


def is_bucket(output):
    return output.startswith("s3://")


def encoded(key):
    """A key as a part of an address: letters of all scripts stay readable."""
    return re.sub(r"[^\w/!$&'()*+,;=:@~.-]", lambda found: urllib.parse.quote(found[0]), key)


def _client():
    """Amazon's library, which knows about keys, retries and uploads in parts, and its session."""
    try:
        import boto3
        import botocore
        from botocore.config import Config
    except ImportError as problem:
        raise PointFrontError(
            f"a bucket needs the package boto3 ({problem}): pip install 'pointfront[cluster]'; on "
            "Debian python3-boto3") from problem
    known = os.environ
    endpoint = known.get("AWS_ENDPOINT_URL_S3") or known.get("AWS_ENDPOINT_URL")
    options = {"signature_version": "s3v4", "retries": {"mode": "standard", "max_attempts": TRIES},
               # As the tool has it: names of buckets are no hosts of other providers.
               "s3": {"addressing_style": "path" if endpoint else "auto"}}
    if known.get("AWS_NO_SIGN_REQUEST", "").lower() in ("yes", "true", "1"):
        options["signature_version"] = botocore.UNSIGNED
    with contextlib.suppress(TypeError):  # providers that do not know Amazon's newer checksums
        Config(request_checksum_calculation="when_required")
        options["request_checksum_calculation"] = "when_required"
    session = boto3.session.Session()
    region = known.get("AWS_REGION") or session.region_name or "us-east-1"
    return session, session.client("s3", endpoint_url=endpoint, region_name=region,
                                   config=Config(**options)), region


class Bucket:
    """Objects below an address. Each is there as a whole or not; a new one takes the place of an
    old one at once.

    Keys, region and endpoint are those of AWS's variables and files. PointFrontError: what was
    refused, and where.
    """

    def __init__(self, address):
        found = re.fullmatch(r"s3://([^/?#]+)((?:/[^?#]*)?)", address)
        if not found:
            raise PointFrontError(f"{address}: no bucket's address: s3://BUCKET/PREFIX is expected")
        self.bucket, self.prefix = found[1], found[2].strip("/")
        self.output = f"s3://{self.bucket}/{self.prefix}".rstrip("/")
        # The tool takes keys out of addresses, where blanks and the like are percent-encoded.
        self.address = f"s3://{self.bucket}/{encoded(self.prefix)}".rstrip("/")
        self.name = self.output.rsplit("/", maxsplit=1)[-1]
        self.session, self.client, self.region = _client()
        payer = os.environ.get("AWS_REQUEST_PAYER")
        self.extra = {"RequestPayer": payer} if payer else {}

    def key(self, name):
        return f"{self.prefix}/{name}".lstrip("/")

    @contextlib.contextmanager
    def _told(self, what, name):
        """Words for what Amazon's library raises."""
        from boto3.exceptions import Boto3Error
        from botocore.exceptions import BotoCoreError, ClientError, NoCredentialsError

        try:
            yield
        except NoCredentialsError as problem:
            raise PointFrontError(
                f"cannot {what} {self.address}/{name}: there are no keys; set AWS_ACCESS_KEY_ID "
                "and AWS_SECRET_ACCESS_KEY, or AWS_PROFILE") from problem
        except (ClientError, BotoCoreError, Boto3Error) as problem:
            raise PointFrontError(f"cannot {what} {self.address}/{name}: {problem}") from problem

    def put(self, path, name):
        """Uploads a file, in parts where it is large."""
        with self._told("write", name):
            self.client.upload_file(path, self.bucket, self.key(name), ExtraArgs=self.extra)

    def put_text(self, text, name):
        with self._told("write", name):
            self.client.put_object(Bucket=self.bucket, Key=self.key(name), Body=text.encode(),
                                   **self.extra)

    def get(self, name, path):
        """Downloads an object to a file, unless there is none."""
        from botocore.exceptions import ClientError

        os.makedirs(os.path.dirname(path), exist_ok=True)
        with self._told("read", name):
            try:
                self.client.download_file(self.bucket, self.key(name), path, ExtraArgs=self.extra)
            except ClientError as problem:
                if problem.response["Error"]["Code"] not in ("404", "NoSuchKey"):
                    raise
                with contextlib.suppress(FileNotFoundError):
                    os.unlink(path)

    def names(self, beginning):
        """All names that begin so."""
        with self._told("list", beginning):
            pages = self.client.get_paginator("list_objects_v2").paginate(
                Bucket=self.bucket, Prefix=self.key(beginning), **self.extra)
            cut = len(self.key(""))
            return [found["Key"][cut:] for page in pages for found in page.get("Contents", ())]

    def remove(self, name):
        with self._told("remove", name):
            self.client.delete_object(Bucket=self.bucket, Key=self.key(name), **self.extra)

    def environment(self):
        """The environment for the tool, whose requests then have the keys that this has."""
        known = dict(os.environ, AWS_REGION=self.region)
        keys = self.session.get_credentials()
        if keys is not None:
            keys = keys.get_frozen_credentials()
            known.update(AWS_ACCESS_KEY_ID=keys.access_key, AWS_SECRET_ACCESS_KEY=keys.secret_key)
            known.pop("AWS_SESSION_TOKEN", None)
            if keys.token:
                known["AWS_SESSION_TOKEN"] = keys.token
        return known


class Workplace:
    """A folder of this machine where steps for a bucket are done: it gets what a step needs, and
    what the step has made is uploaded. Nothing in the bucket names what is not there yet: a tile
    comes before its record, the collection after all tiles.
    """

    EVERY = 5.0  # seconds between two looks for the word to stop

    def __init__(self, address):
        self.bucket = Bucket(address)
        self.address = self.bucket.address
        own = _own_folder()
        if own is None:
            _remove_abandoned(tempfile.gettempdir())
        self._place = tempfile.TemporaryDirectory(  # pylint: disable=consider-using-with
            prefix="pointfront-", dir=own)
        self._in_use = _marked(self._place.name)
        self.folder = os.path.join(self._place.name, self.bucket.name)
        self.collection = f"{self.bucket.name}.pfcollection"
        self.options = ("-o", self.folder, "--published", self.address)
        self._here = set()
        self._fetching = threading.Lock()
        self._looked = 0.0
        for name in ("work", "tiles"):
            os.makedirs(self.path(name))

    @staticmethod
    def of(address, run):
        """The workplace that this process has for one run of a build."""
        with _lock:
            if (address, run) not in _known:
                _known[address, run] = Workplace(address)
            return _known[address, run]

    @property
    def environment(self):
        return self.bucket.environment()

    def path(self, name):
        return os.path.join(self.folder, *name.split("/"))

    def public(self, text):
        """The tool's words with the bucket's names."""
        text = text.replace(self.path(self.collection),
                            f"{self.address}/{encoded(self.collection)}")
        return text.replace(self.folder, self.address)

    def log(self, name, text):
        """That of the last try of a step."""
        self.bucket.put_text(text, f"work/logs/{name}")

    def stop(self, mark, wanted=True):
        """Ends the steps of a run, or takes the word back."""
        if wanted:
            self.bucket.put_text("", mark)
        else:
            self.bucket.remove(mark)

    def stopped(self, mark):
        now = time.monotonic()
        if now - self._looked < self.EVERY:
            return False
        self._looked = now
        return mark in self.bucket.names(mark)

    def _fetch(self, names):
        """Downloads what is there of those, anew."""
        with ThreadPoolExecutor(AT_ONCE) as pool:
            list(pool.map(lambda name: self.bucket.get(name, self.path(name)), names))

    def _share(self, names):
        """Fetches what all steps of a phase need, once."""
        missing = sorted(set(names) - self._here)
        self._fetch(missing)
        self._here |= set(missing)

    def prepare(self, step):
        """Fetches what a step needs, if it is there."""
        kind, _, number = step.partition(":")
        with self._fetching:
            if kind == "plan":
                self._fetch(["work/plan.json"])
            elif kind == "settle":
                self._fetch(["work/tiles.json", *self.bucket.names("work/survey-")])
            elif kind == "collect":
                self._fetch([*self.bucket.names("work/tile-"), "work/collection.json",
                             self.collection])
            elif kind == "survey":
                self._share(["work/plan.json"])
            elif "work/tiles.json" not in self._here:
                self._share(["work/plan.json", "work/tiles.json",
                             *self.bucket.names("work/survey-")])
        if number:
            self._fetch([f"work/{kind}-{number}.json"])

    def publish(self, step):
        """Uploads what a step has made."""
        kind, _, number = step.partition(":")
        record = f"work/{kind}-{number}.json"
        if kind == "plan":
            self._put("work/plan.json")
        elif kind == "settle":
            self._put("work/tiles.json")
        elif kind == "survey":
            self._put(record)
        elif kind == "tile":
            store = self._store(record)
            self._put(store)
            self._put(record)
            os.unlink(self.path(store))
        else:
            self._put(self.collection)
            self._put("work/collection.json")
            self._remove_others()

    def _put(self, name):
        self.bucket.put(self.path(name), name)

    def _store(self, record):
        """The tile's file that a record is of."""
        with open(self.path(record), encoding="utf-8") as file:
            return "tiles/" + json.load(file)["file"]

    def _remove_others(self):
        """Tiles and records of tiles that are no part any more: the tool has removed the latter
        from the folder. Never an input."""
        records = {f"work/{name}" for name in os.listdir(self.path("work"))
                   if OWN.fullmatch(f"work/{name}")}
        with open(self.path("work/plan.json"), encoding="utf-8") as file:
            inputs = {one["path"].removeprefix(f"{self.address}/")
                      for one in json.load(file)["inputs"]}
        kept = records | inputs | {self._store(name) for name in records}
        for name in (*self.bucket.names("tiles/"), *self.bucket.names("work/tile-")):
            if OWN.fullmatch(name) and name not in kept:
                self.bucket.remove(name)


def _marked(place):
    """The open file that says that the folder is in use, as long as this process lives."""
    draft = os.path.join(place, f"{IN_USE}.new")
    file = open(draft, "wb")  # pylint: disable=consider-using-with
    fcntl.flock(file, fcntl.LOCK_EX)
    os.rename(draft, os.path.join(place, IN_USE))  # locked from the first
    return file


def _remove_abandoned(parent):
    """Removes folders of builds that were killed."""
    for mark in glob.glob(os.path.join(glob.escape(parent), "pointfront-*", IN_USE)):
        with contextlib.suppress(OSError), open(mark, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            shutil.rmtree(os.path.dirname(mark))


def _own_folder():
    """The folder of Dask's worker, which removes it also after a kill; None: the system's."""
    with contextlib.suppress(Exception):
        from distributed import get_worker

        return get_worker().local_directory
    return None
