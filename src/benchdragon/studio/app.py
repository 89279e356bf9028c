"""The studio: a server for the page on which a dance is planned, judged and watched.

It computes nothing itself: worker processes do (`workers`), what may be asked stands in
`tasks.TASKS`, what it bears in `limits`. Addresses stand in `_routes`.
"""

import asyncio
import os
import signal
import socket
from collections import OrderedDict
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from hashlib import sha256
from pathlib import Path
from typing import Annotated, Any, Literal, cast

from pydantic_core import ErrorDetails

from benchdragon.analysis.records import Answer, Verdict
from benchdragon.errors import BenchDragonError, InputError, MissingExtraError, reason
from benchdragon.i18n import _, language
from benchdragon.inlining import chinese
from benchdragon.plans.faults import fault_of
from benchdragon.plans.presets import presets
from benchdragon.plans.schema import Plan
from benchdragon.player.messages import Dance
from benchdragon.studio import messages
from benchdragon.studio.jobs import Jobs
from benchdragon.studio.limits import Settings
from benchdragon.studio.security import ANYWHERE, Gate
from benchdragon.studio.tasks import EXPORTED, TaskRequest, TaskResult
from benchdragon.studio.workers import Pool, QueuedTask, RefusedError
from benchdragon.version import __version__

try:
    import uvicorn
    from fastapi import APIRouter, Depends, FastAPI, Header, Query, Request, Response
    from fastapi import Path as InPath
    from fastapi.exceptions import RequestValidationError
    from fastapi.responses import JSONResponse
    from starlette.exceptions import HTTPException
except ImportError:
    raise MissingExtraError("studio") from None

WEB_FOLDER = Path(__file__).parents[1] / "web"
PAGE = "studio.html"
# On every answer about a plan, the refusals too: which plan it was. Pages show no answer without asking
# whether that is the plan they show.
SUBJECT = "X-Plan-SHA256"
STATIC = {".js": "text/javascript", ".css": "text/css"}
PROBLEMS = {
    400: "The body is not JSON.",
    403: "A page from elsewhere asked.",
    408: "The request did not come whole in time.",
    409: "A newer question of the same client took this one's place.",
    413: "The body is too large.",
    415: "The body is not of the type application/json.",
    421: "The studio does not go by that name.",
    422: "The plan, or another value, cannot be used.",
    429: "Too many questions wait.",
    500: "Something is wrong with the studio.",
    503: "The worker died, or the studio is closing or crowded.",
    504: "No answer within the time limit.",
    507: "The answer takes more memory than a question may have.",
}

Language = Annotated[
    Literal["en", "zh"] | None,
    Query(alias="lang", description="Of every sentence; else Accept-Language."),
]
Client = Annotated[
    str | None,
    Header(
        alias="X-Client",
        pattern="^[A-Za-z0-9_-]{1,64}$",
        description="A random name: newer questions replace this client's older ones.",
    ),
]
Name = Annotated[str, InPath(pattern="^[A-Za-z0-9_.-]{1,64}$")]


class Answers:
    """The answers last given, at most so many bytes of them."""

    def __init__(self, most: int) -> None:
        self._most, self._size = most, 0
        self._kept: OrderedDict[str, TaskResult] = OrderedDict()

    def get(self, key: str) -> TaskResult | None:
        """The answer under a key, if it is still there."""
        if key in self._kept:
            self._kept.move_to_end(key)
        return self._kept.get(key)

    def keep(self, key: str, result: TaskResult) -> None:
        """Keep an answer; the oldest go."""
        if key in self._kept or len(result.data) > self._most // 8:
            return
        self._kept[key] = result
        self._size += len(result.data)
        while self._size > self._most:
            self._size -= len(self._kept.popitem(last=False)[1].data)


class Studio:
    """What one studio holds: settings, workers, long questions, answers kept."""

    def __init__(self, settings: Settings) -> None:
        self.settings = settings
        self.pool = Pool(settings)
        self.jobs = Jobs(self.pool.queues["jobs"], settings)
        self.answers = Answers(settings.cache)

    def task(self, name: str, plan: Plan | None, client: str | None, **more: Any) -> QueuedTask:
        """A question in the language of the request."""
        spoken = more.pop("language", None) or language()
        return QueuedTask(TaskRequest(name, spoken, self.settings, plan, **more), client)

    async def answer(self, request: Request, task: QueuedTask) -> Response:
        """The answer to a question, kept or new.

        Raises:
            RefusedError: if there is none.
        """
        _subject(request, task.request.plan)
        key = _key(task.request)
        result = self.answers.get(key)
        if result is None:
            result = await self._computed(request, task)
            if result.name is None:
                self.answers.keep(key, result)
        headers = dict(request.state.subject)
        if result.name is not None:
            headers["Content-Disposition"] = f'attachment; filename="{result.name}"'
        return Response(result.data, media_type=result.media, headers=headers)

    async def _computed(self, request: Request, task: QueuedTask) -> TaskResult:
        worker_queue = self.pool.worker_queue(task.request.name)
        worker_queue.put(task)
        future = asyncio.wrap_future(task.future)
        gone = asyncio.ensure_future(_gone(request))
        both: set[asyncio.Future[Any]] = {future, gone}
        try:
            done, _pending = await asyncio.wait(
                both, timeout=self.settings.wait_seconds, return_when=asyncio.FIRST_COMPLETED
            )
            if not done and not worker_queue.withdraw(task, 503, worker_queue.late):
                await asyncio.wait(both, return_when=asyncio.FIRST_COMPLETED)
            if gone.done():
                worker_queue.abandon(task)
            return await future
        finally:
            gone.cancel()


def _subject(request: Request, plan: Plan | None) -> None:
    """Note which plan a request asks about."""
    request.state.subject = {} if plan is None else {SUBJECT: plan.sha256}


async def _gone(request: Request) -> None:
    """Wait until the client is gone."""
    while (await request.receive())["type"] != "http.disconnect":
        pass


def _key(request: TaskRequest) -> str:
    """A name of all that an answer depends on."""
    plan = "" if request.plan is None else request.plan.model_dump_json()
    parts = (request.name, request.language, request.text, plan)
    return sha256("\0".join(parts).encode()).hexdigest()


def app(settings: Settings | None = None) -> FastAPI:
    """The studio as an application, to be served by any ASGI server, in one process."""
    chosen = settings or Settings()
    studio = Studio(chosen)

    @asynccontextmanager
    async def lifespan(_application: FastAPI) -> AsyncIterator[None]:
        studio.pool.start()
        yield
        await asyncio.to_thread(studio.pool.close)

    application = FastAPI(
        title="benchdragon studio",
        version=__version__,
        docs_url=None,  # they would load from a network
        redoc_url=None,
        redirect_slashes=False,
        lifespan=lifespan,
    )
    application.state.studio = studio
    application.add_middleware(Gate, settings=chosen)
    application.add_exception_handler(HTTPException, _http_problem)
    application.add_exception_handler(RequestValidationError, _invalid)
    application.add_exception_handler(BenchDragonError, _wrong)
    application.add_exception_handler(RefusedError, _refused)
    _page_routes(application)
    _fact_routes(application, studio)
    router = APIRouter(prefix="/api", dependencies=[Depends(_spoken)])
    _quick_routes(router, studio)
    _job_routes(router, studio)
    application.include_router(router)
    return application


async def _spoken(_lang: Language = None) -> None:
    """Check and describe `lang`, which the gate has obeyed."""


def _documented(*statuses: int) -> dict[int | str, dict[str, Any]]:
    """OpenAPI's description of all problems that a route can come to."""
    always = (403, 421, 500)
    found: dict[int | str, dict[str, Any]] = {
        status: {"model": messages.Problem, "description": PROBLEMS.get(status, "There is none.")}
        for status in sorted({*always, *statuses})
    }
    return found


ASKED = (400, 408, 413, 415, 422)
COMPUTED = (*ASKED, 409, 429, 503, 504, 507)


def _file(*media: str) -> dict[str, Any]:
    """How a file of one of these kinds is described."""
    return {"content": {name: {"schema": {"type": "string", "format": "binary"}} for name in media}}


def _page_routes(application: FastAPI) -> None:
    get = application.get

    @get("/", response_class=Response, responses={**_documented(), 200: _file("text/html")})
    async def page() -> Response:
        """The page."""
        return Response((WEB_FOLDER / PAGE).read_bytes(), media_type="text/html")

    @get(
        "/static/{name}",
        response_class=Response,
        responses={**_documented(404, 422), 200: {"content": {media: {} for media in STATIC.values()}}},
    )
    async def static(name: Name) -> Response:
        """A script or a style of the page."""
        path = {path.name: path for path in WEB_FOLDER.iterdir()}.get(name)
        if path is None or path.suffix not in STATIC:
            raise RefusedError(404, _("there is nothing at this address"))
        return Response(path.read_bytes(), media_type=STATIC[path.suffix])


def _fact_routes(application: FastAPI, studio: Studio) -> None:
    get = application.get

    @get("/healthz", responses=_documented())
    async def health() -> messages.Health:
        """How the studio stands; a lane that is not ready yet compiles the kernels."""
        queues = {
            name: messages.QueueState(
                workers=worker_queue.count,
                ready=worker_queue.ready,
                busy=worker_queue.busy,
                waiting=worker_queue.waiting,
            )
            for name, worker_queue in studio.pool.queues.items()
        }
        return messages.Health(status="ok", version=__version__, workers=queues)

    @get("/api/words", responses=_documented())
    async def words() -> dict[str, str]:
        """Chinese for every sentence of the page."""
        return chinese("studio.js")

    @get("/api/presets", responses=_documented())
    async def preset_list() -> list[messages.Preset]:
        """Dances to begin with, the paper's and real villages'."""
        return [messages.Preset.model_validate(preset) for preset in presets()]


def _computed_route(good: dict[str, Any]) -> dict[str, Any]:
    """How FastAPI is told of a route that hands on what a worker computed."""
    responses = {**_documented(*COMPUTED), 200: good}
    return {"response_class": Response, "response_model": None, "responses": responses}


def _quick_routes(router: APIRouter, studio: Studio) -> None:
    @router.post("/verdict", **_computed_route({"model": Verdict}))
    async def verdict(request: Request, body: messages.PlanBody, client: Client = None) -> Response:
        """Whether a walk is safe."""
        return await studio.answer(request, studio.task("verdict", body.plan, client))

    @router.post("/dance", **_computed_route({"model": Dance}))
    async def dance(request: Request, body: messages.PlanBody, client: Client = None) -> Response:
        """The dance as the player shows it."""
        return await studio.answer(request, studio.task("dance", body.plan, client))

    @router.post("/limit/{what}", **_computed_route({"model": Answer}))
    async def limit(
        request: Request, what: messages.LimitName, body: messages.PlanBody, client: Client = None
    ) -> Response:
        """How small (pitch, disc) or large (width, length) a size may be, m."""
        return await studio.answer(request, studio.task(f"limit/{what}", body.plan, client))

    @router.post("/plan", **_computed_route({"model": messages.OpenedPlan}))
    async def opened(request: Request, body: messages.TextBody, client: Client = None) -> Response:
        """The plan in the text of a plan file."""
        return await studio.answer(request, studio.task("open", None, client, text=body.toml))

    @router.post("/toml", **_computed_route(_file("application/toml")))
    async def text(request: Request, body: messages.PlanBody, client: Client = None) -> Response:
        """The plan as a plan file."""
        return await studio.answer(request, studio.task("toml", body.plan, client))

    @router.post("/export/{kind}", **_computed_route(_file(*EXPORTED)))
    async def export(
        request: Request, kind: messages.ExportName, body: messages.ExportBody, client: Client = None
    ) -> Response:
        """A table, a page, or the pictures as a zip."""
        task = studio.task(f"export/{kind}", body.plan, client, language=body.lang)
        return await studio.answer(request, task)


def _job_routes(router: APIRouter, studio: Studio) -> None:
    @router.post("/jobs", status_code=202, responses=_documented(*ASKED, 429, 503))
    async def start(
        request: Request, response: Response, body: messages.JobBody, client: Client = None
    ) -> messages.JobStarted:
        """Take on a long question."""
        _subject(request, body.plan)
        response.headers.update(request.state.subject)
        task = studio.task(f"job/{body.question}", body.plan, client, options=body.options)
        return messages.JobStarted(id=studio.jobs.start(body.question, task))

    @router.get("/jobs", responses=_documented(422))
    async def mine(client: Client = None) -> list[messages.JobTaken]:
        """The long questions of a client that are not forgotten, oldest first."""
        return [
            messages.JobTaken(
                id=job.id, question=job.question, plan=job.plan, plan_sha256=job.plan.sha256
            )
            for job in studio.jobs.of(client)
        ]

    known = {**_documented(404, 422), 200: {"model": messages.JobState}}

    @router.get("/jobs/{name}", response_model=None, responses=known)
    async def state(name: Name) -> JSONResponse:
        """How a long question stands."""
        return JSONResponse(studio.jobs.found(name).state)

    @router.delete("/jobs/{name}", response_model=None, responses=known)
    async def cancel(name: Name) -> JSONResponse:
        """Cancel a long question, waiting or running; forget one that has ended."""
        return JSONResponse(studio.jobs.cancel(name).state)


def _problem(status: int, text: str, headers: Any = None) -> JSONResponse:
    return JSONResponse({"error": text}, status, headers)


async def _refused(request: Request, refusal: Exception) -> JSONResponse:
    if not isinstance(refusal, RefusedError):
        raise refusal
    retry = {} if refusal.retry is None else {"Retry-After": str(refusal.retry)}
    subject: dict[str, str] = getattr(request.state, "subject", {})
    return _problem(refusal.status, refusal.text, {**retry, **subject})


async def _wrong(_request: Request, error: Exception) -> JSONResponse:
    return _problem(422, str(error))


async def _http_problem(_request: Request, error: Exception) -> JSONResponse:
    if not isinstance(error, HTTPException):
        raise error
    texts = {
        404: _("there is nothing at this address"),
        405: _("this address does not take that method"),
    }
    return _problem(error.status_code, texts.get(error.status_code, str(error.detail)), error.headers)


async def _invalid(_request: Request, error: Exception) -> JSONResponse:
    """The first thing that is wrong with a body, a path or a header that is no plan."""
    if not isinstance(error, RequestValidationError):
        raise error
    first = error.errors()[0]
    where = ".".join(str(step) for step in first["loc"][1:]) or str(first["loc"][0])
    if first["type"] == "extra_forbidden":
        return _problem(422, _("{where} is not a known key").format(where=where))
    details = cast("ErrorDetails", {**first, "loc": tuple(first["loc"][1:]) or first["loc"]})
    return _problem(422, fault_of(details, {}, messages.Body).text)


class _Server(uvicorn.Server):
    """Tells when it listens; on its way out tells first those who wait for answers."""

    def __init__(self, config: uvicorn.Config, studio: Studio, listening: Callable[[], None]) -> None:
        super().__init__(config)
        self._studio, self._listening = studio, listening

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await super().startup(sockets)
        self._listening()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        await asyncio.to_thread(self._studio.pool.close)
        await super().shutdown(sockets)


def listener(settings: Settings) -> socket.socket:
    """A socket at the studio's address.

    Raises:
        InputError: if it cannot be had.
    """
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    # asyncio sends small answers at once only where the protocol is named.
    found = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    try:
        if os.name == "posix":
            found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        found.bind((settings.host, settings.port))
    except (OSError, OverflowError, UnicodeError) as error:
        found.close()
        why = reason(error) if isinstance(error, OSError) else str(error)
        raise InputError(
            _("cannot listen at {host}, port {port}: {why}").format(
                host=settings.host, port=settings.port, why=why
            )
        ) from None
    return found


def address(settings: Settings, listening: socket.socket) -> str:
    """Where a browser on this machine finds the studio."""
    host = "127.0.0.1" if settings.host in ANYWHERE else settings.host
    host = f"[{host}]" if ":" in host else host
    return f"http://{host}:{listening.getsockname()[1]}/"


def serve(settings: Settings, listening: Callable[[str], None]) -> None:
    """Serve until Ctrl-C or SIGTERM; `listening` is told the address once there is one.

    Raises:
        InputError: if the address cannot be had.
    """
    application = app(settings)
    ours = listener(settings)
    config = uvicorn.Config(
        application, log_config=None, access_log=False, ws="none", server_header=False,
        timeout_graceful_shutdown=int(settings.grace) + 1, timeout_keep_alive=20,
        limit_concurrency=settings.connections, h11_max_incomplete_event_size=65_536,
    )  # fmt: skip
    studio: Studio = application.state.studio
    server = _Server(config, studio, lambda: listening(address(settings, ours)))
    before = {name: signal.signal(name, lambda *_: None) for name in (signal.SIGINT, signal.SIGTERM)}
    try:
        server.run(sockets=[ours])
    finally:
        studio.pool.close(0.0)
        for name, handler in before.items():
            signal.signal(name, handler)
