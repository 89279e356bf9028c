"""Pages whose processes run a part of the time, as on a slower machine."""

import os
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

from playwright.sync_api import Browser

# Seconds of a turn in which a slowed process runs and is stopped.
TURN = 0.02


def renderers(browser: Browser) -> list[int]:
    """Processes that draw and compute pages."""
    session = browser.new_browser_cdp_session()
    told = session.send("SystemInfo.getProcessInfo")["processInfo"]
    session.detach()
    return [int(one["id"]) for one in told if one["type"] == "renderer"]


@contextmanager
def slowed(browser: Browser, times: int) -> Iterator[None]:
    """Let the pages' processes run one part in so many of the time."""
    processes, over = renderers(browser) if times > 1 else [], threading.Event()

    def stop_and_go() -> None:
        while not over.is_set():
            for sent, share in ((signal.SIGSTOP, 1.0 - 1.0 / times), (signal.SIGCONT, 1.0 / times)):
                for process in processes:
                    os.kill(process, sent)
                time.sleep(TURN * share)

    thread = threading.Thread(target=stop_and_go)
    if processes:
        thread.start()
    try:
        yield
    finally:
        over.set()
        if processes:
            thread.join()
