"""Checks signatures of Amazon's version 4 (SigV4), written from its description alone."""

import hashlib
import hmac
import urllib.parse

KEY_ID = "AKIDEXAMPLE"
KEY = "wJalrXUtnFEMI/K7MDENG+bPxRfiCYEXAMPLEKEY"
SESSION = "a-session-of-the-tests"


def _mac(key, text):
    return hmac.new(key, text.encode(), hashlib.sha256).digest()


def _canonical_query(query):
    pairs = urllib.parse.parse_qsl(query, keep_blank_values=True)
    quoted = sorted((urllib.parse.quote(name, safe="-_.~"), urllib.parse.quote(value, safe="-_.~"))
                    for name, value in pairs)
    return "&".join(f"{name}={value}" for name, value in quoted)


def fault_of(method, path, headers):
    """None if the request is signed by KEY; otherwise what is wrong."""
    text = headers.get("Authorization", "")
    if not text.startswith("AWS4-HMAC-SHA256 "):
        return "no signature"
    parts = dict(part.strip().split("=", 1) for part in text.split(" ", 1)[1].split(","))
    key_id, date, region, service, end = parts["Credential"].split("/")
    if (key_id, service, end) != (KEY_ID, "s3", "aws4_request"):
        return "another key or service"
    moment = headers.get("X-Amz-Date", "")
    if moment[:8] != date:
        return "the date is not that of the scope"
    names = parts["SignedHeaders"].split(";")
    if names != sorted(names) or "host" not in names:
        return "headers are not in order, or without the host"
    place = urllib.parse.urlsplit(path)
    payload = headers.get("X-Amz-Content-Sha256") or hashlib.sha256(b"").hexdigest()
    canonical = "\n".join([
        method, place.path, _canonical_query(place.query),
        *(f"{name}:{' '.join(headers.get(name, '').split())}" for name in names), "",
        ";".join(names), payload])
    scope = "/".join([date, region, service, end])
    to_sign = "\n".join(["AWS4-HMAC-SHA256", moment, scope,
                         hashlib.sha256(canonical.encode()).hexdigest()])
    key = ("AWS4" + KEY).encode()
    for step in (date, region, service, end):
        key = _mac(key, step)
    expected = hmac.new(key, to_sign.encode(), hashlib.sha256).hexdigest()
    return None if hmac.compare_digest(expected, parts["Signature"]) else "a wrong signature"
