"""The studio's gate: what every request must be before anything looks at it, and what answers bear.

Browsers send what any page asks them to send. A foreign page must neither read nor cause anything
here: hosts are checked against rebound names, origins and the type of bodies against forged requests.
"""

import asyncio
import ipaddress
import json
import logging
from collections.abc import Awaitable, Callable, MutableMapping
from typing import Any, NoReturn
from urllib.parse import parse_qs, urlsplit

from benchdragon.errors import InputError
from benchdragon.i18n import LANGUAGES, _, language, spoken_in
from benchdragon.studio.limits import Settings
from benchdragon.studio.tasks import check_depth
from benchdragon.studio.workers import BROKEN, RefusedError

LOG = logging.getLogger(__name__)
LOOPBACK = frozenset({"localhost", "127.0.0.1", "::1"})
ANYWHERE = frozenset({"0.0.0.0", "::", ""})
# Scripts, styles and connections from here alone, nothing inline, in no one's frame.
HEADERS = {
    "content-security-policy": (
        "default-src 'self'; img-src 'self' data:; object-src 'none'; base-uri 'none'; "
        "form-action 'self'; frame-ancestors 'none'"
    ),
    "x-content-type-options": "nosniff",
    "referrer-policy": "no-referrer",
    "x-frame-options": "DENY",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "permissions-policy": "camera=(), geolocation=(), microphone=()",
    "cache-control": "no-store",
}

Message = MutableMapping[str, Any]
Scope = MutableMapping[str, Any]
Receive = Callable[[], Awaitable[Message]]
Send = Callable[[Message], Awaitable[None]]
Application = Callable[[Scope, Receive, Send], Awaitable[None]]


class Gate:
    """Stands before an application."""

    def __init__(self, app: Application, settings: Settings) -> None:
        self._app, self._settings = app, settings
        names = {name.lower().strip("[]") for name in (*settings.names, settings.host)}
        self._names = LOOPBACK | (names - ANYWHERE)
        self._any_address = settings.host in ANYWHERE

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let a request through, or answer it with a sentence."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
        elif scope["type"] == "http":
            with spoken_in(_language(scope)):
                await self._http(scope, receive, _Answer(send))
        else:  # no other protocol is spoken here
            await send({"type": "websocket.close", "code": 1008})

    async def _http(self, scope: Scope, receive: Receive, answer: "_Answer") -> None:
        try:
            self._check_host(scope)
            if scope["method"] == "POST":
                receive = await self._checked_body(scope, receive)
            await self._app(scope, receive, answer)
        except RefusedError as refusal:
            await answer.refuse(refusal)
        except Exception:
            LOG.exception("%s %s", scope["method"], scope["path"])
            if not answer.begun:
                await answer.refuse(RefusedError(500, _(BROKEN)))

    def _check_host(self, scope: Scope) -> None:
        """Refuse a name that is not ours, which may have been made to lead here; and foreign pages.

        Raises:
            RefusedError: 421 or 403.
        """
        host = _only(scope, b"host")
        if not self._known(_host(f"//{host}")):
            raise RefusedError(
                421, _("this studio does not go by the name {host}").format(host=repr(host))
            )
        origin = _only(scope, b"origin")
        if origin and _origin(origin) != host.lower():
            raise RefusedError(403, _("a page from elsewhere may not ask here"))

    def _known(self, name: str | None) -> bool:
        if name is None:
            return False
        if name in self._names:
            return True
        try:  # an address cannot be rebound, a name can
            ipaddress.ip_address(name)
        except ValueError:
            return False
        return self._any_address

    async def _checked_body(self, scope: Scope, receive: Receive) -> Receive:
        """The body, read whole and found to be plain JSON, to be received again.

        Raises:
            RefusedError: 400, 408, 413 or 415.
        """
        kind = _only(scope, b"content-type").partition(";")[0].strip().lower()
        if kind != "application/json":
            raise RefusedError(
                415, _("wanted a body of the type application/json, not {kind}").format(kind=repr(kind))
            )
        try:
            async with asyncio.timeout(self._settings.body_seconds):
                body = await self._read(receive)
        except TimeoutError:
            raise RefusedError(408, _("the request did not come whole in time")) from None
        _check_json(body, self._settings.depth)
        pending: list[Message] = [{"type": "http.request", "body": body, "more_body": False}]

        async def again() -> Message:
            return pending.pop() if pending else await receive()

        return again

    async def _read(self, receive: Receive) -> bytes:
        most, drain = self._settings.body, self._settings.drain
        parts, size, more = [], 0, True
        while more:
            message = await receive()
            if message["type"] == "http.disconnect":
                raise RefusedError(400, _("the request broke off"))
            size += len(message.get("body", b""))
            if size <= most:
                parts.append(message.get("body", b""))
            more = message.get("more_body", False) and size <= drain
        if size > most:
            text = _("a request may hold {most} bytes, and this one holds more")
            raise RefusedError(413, text.format(most=most))
        return b"".join(parts)


class _Answer:
    """Sends an answer with the headers that all bear."""

    def __init__(self, send: Send) -> None:
        self._send = send
        self.begun = False

    async def __call__(self, message: Message) -> None:
        if message["type"] == "http.response.start":
            self.begun = True
            headers = [(name.lower(), value) for name, value in message.get("headers", [])]
            has = {name for name, _value in headers}
            headers += [
                (name.encode(), value.encode())
                for name, value in HEADERS.items()
                if name.encode() not in has
            ]
            headers.append((b"content-language", language().encode()))
            message = {**message, "headers": headers}
        await self._send(message)

    async def refuse(self, refusal: RefusedError) -> None:
        """Answer with a sentence."""
        body = json.dumps({"error": refusal.text}).encode()
        headers = [(b"content-type", b"application/json"), (b"content-length", str(len(body)).encode())]
        if refusal.retry is not None:
            headers.append((b"retry-after", str(refusal.retry).encode()))
        if refusal.status in {408, 413}:  # what is left of the body stays unread
            headers.append((b"connection", b"close"))
        await self({"type": "http.response.start", "status": refusal.status, "headers": headers})
        await self({"type": "http.response.body", "body": body})


def _check_json(body: bytes, depth: int) -> None:
    """Refuse what is not JSON that can be said again: bad text, NaN, half signs, brackets too deep.

    Raises:
        RefusedError: 400.
    """
    try:
        data = json.loads(body.decode("utf-8"), parse_constant=_refuse_constant)
        check_depth(data, depth)
        json.dumps(data, ensure_ascii=False).encode("utf-8")
    except (InputError, RecursionError):
        text = _("wanted brackets at most {most} deep").format(most=depth)
        raise RefusedError(400, text) from None
    except ValueError as error:  # UnicodeError and JSONDecodeError too
        raise RefusedError(
            400, _("the body is not JSON: {error}").format(error=_plain(error))
        ) from None


def _plain(error: ValueError) -> str:
    return str(error).encode("ascii", "backslashreplace").decode()[:200]


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(_("{name} is no number there").format(name=name))


def _only(scope: Scope, name: bytes) -> str:
    """The value of a header; with several of the same name, none that would pass."""
    values: list[bytes] = [value for key, value in scope["headers"] if key.lower() == name]
    return str(b", ".join(values), "latin-1")


def _host(text: str) -> str | None:
    """The host name in the text of an address, in small letters."""
    try:
        parts = urlsplit(text)
        _port = parts.port
    except ValueError:
        return None
    plain = not parts.path and not parts.query and not parts.fragment and "@" not in parts.netloc
    return parts.hostname if plain else None


def _origin(origin: str) -> str | None:
    """Host and port of an origin in small letters; None for what is no origin of the web."""
    try:
        parts = urlsplit(origin)
    except ValueError:
        return None
    return parts.netloc.lower() if parts.scheme in {"http", "https"} else None


def _language(scope: Scope) -> str:
    """What `lang` asks for, else the browser's languages, else the studio's own."""
    query: bytes = scope["query_string"]
    asked = parse_qs(query.decode("latin-1")).get("lang", [""])[-1]
    if asked in LANGUAGES:
        return asked
    return accepted_language(_only(scope, b"accept-language")) or language()


def accepted_language(text: str) -> str | None:
    """The best of our languages in an Accept-Language header; None where it names none."""
    best, weight = None, 0.0
    for item in text.split(",")[:20]:
        name, _semicolon, parameters = item.strip().partition(";")
        quality = parameters.strip().removeprefix("q=").strip() or "1"
        try:
            share = float(quality)
        except ValueError:
            continue
        tag = name.lower().partition("-")[0]
        if tag in LANGUAGES and share > weight:
            best, weight = tag, share
    return best
