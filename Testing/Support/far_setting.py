"""Names of tests of addresses. Importing it makes this process ask its own server only, keep no
bytes on the disk, and give up soon: import it before pointfront. Soon is when a server that answers
has answered on a busy machine, too."""

import os

HERE = "127.0.0.1"
SECRET = "sig=VERY-SECRET"
LIMIT_SECONDS = 12

for name in [name for name in os.environ if name.lower().endswith("_proxy")]:
    del os.environ[name]
os.environ["POINTFRONT_CACHE"] = "off"
os.environ["POINTFRONT_REMOTE_TIMEOUT"] = str(LIMIT_SECONDS)
