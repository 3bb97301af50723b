#!/usr/bin/env python3
"""rust-analyzer on a package that uses `#[lagrangian]`: completion in a body that is being written, hover on a
generated method, and no message about what is not wrong. Called by `scripts/check.sh editor`.

It speaks the Language Server Protocol, JSON behind a header of its length, on the standard streams."""

import json
import pathlib
import queue
import subprocess
import sys
import tempfile
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent

MANIFEST = f"""[package]
name = "written"
version = "0.1.0"
edition = "2024"

[dependencies]
lagrangian = {{ path = "{ROOT}" }}

[workspace]
"""

PROGRAM = """use lagrangian::prelude::*;

pub struct Pendulum {
    pub mass: f64,
    pub length: f64,
    pub gravity: f64,
}

#[lagrangian(coordinates = [theta])]
impl Pendulum {
    #[point(mass = self.mass)]
    fn bob(&self, q: &Coordinates) -> Vector2<f64> {
        self.length * Vector2::new(q.theta.sin(), -q.theta.cos())
    }

    #[potential]
    fn weight(&self, q: &Coordinates) -> f64 {
        self.mass * self.gravity * self.bob(q).y /*here*/
    }
}

fn main() {
    let pendulum = Pendulum { mass: 1.0, length: 1.0, gravity: 9.81 };
    let motion = pendulum.simulate(State::at_rest([1.0]));
    println!("{}", pendulum.energy(motion.state()));
}
"""

# What somebody types at the mark, letter by letter, to the line that is right again.
TYPED = " + 0.0 * q.theta.sin()"


class Server:
    """rust-analyzer, with what it has said so far."""

    def __init__(self, folder):
        self.process = subprocess.Popen(["rust-analyzer"], cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.said = queue.Queue()
        self.count = 0
        threading.Thread(target=self.listen, daemon=True).start()

    def listen(self):
        stream = self.process.stdout
        while header := stream.readline():
            length = int(header.split(b":")[1]) if header.lower().startswith(b"content-length") else None
            while stream.readline().strip():
                pass
            self.said.put(json.loads(stream.read(length)))

    def send(self, message):
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self.process.stdin.flush()

    def notify(self, method, params):
        self.send({"method": method, "params": params})

    def ask(self, method, params):
        """The answer to a question. One that a change of the text has overtaken is asked again."""
        while True:
            self.count += 1
            self.send({"id": self.count, "method": method, "params": params})
            answer = self.wait(lambda said: said.get("id") == self.count and "method" not in said)
            if "result" in answer:
                return answer["result"]
            if answer["error"]["code"] not in (-32801, -32802):
                sys.exit(f"{method}: {answer['error']}")

    def wait(self, is_wanted):
        end = time.monotonic() + 600
        while True:
            said = self.said.get(timeout=end - time.monotonic())
            if "method" in said and "id" in said:
                # Questions of the server about settings: the defaults.
                items = said["params"].get("items", []) if isinstance(said.get("params"), dict) else []
                self.send({"id": said["id"], "result": [None for _ in items] or None})
            if is_wanted(said):
                return said


class File:
    """An open file."""

    def __init__(self, server, path):
        self.server, self.path, self.version = server, path, 1
        self.name = {"uri": path.as_uri()}
        self.text = path.read_text()
        document = {**self.name, "languageId": "rust", "version": 1, "text": self.text}
        server.notify("textDocument/didOpen", {"textDocument": document})

    def change(self, text):
        self.version += 1
        self.text = text
        document = {**self.name, "version": self.version}
        self.server.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [{"text": text}]})

    def at(self, offset):
        before = self.text[:offset]
        return {"line": before.count("\n"), "character": offset - before.rfind("\n") - 1}

    def errors(self):
        report = self.server.ask("textDocument/diagnostic", {"textDocument": self.name})
        return [item for item in report["items"] if item["severity"] == 1]

    def completions(self, offset):
        place = {"textDocument": self.name, "position": self.at(offset)}
        found = self.server.ask("textDocument/completion", place)
        items = found["items"] if isinstance(found, dict) else found or []
        return [item["label"] for item in items]

    def hover(self, offset):
        place = {"textDocument": self.name, "position": self.at(offset)}
        found = self.server.ask("textDocument/hover", place)
        return found["contents"]["value"] if found else ""


def started(folder):
    server = Server(folder)
    capabilities = {
        "experimental": {"serverStatusNotification": True},
        "textDocument": {"diagnostic": {}, "hover": {"contentFormat": ["markdown"]}},
    }
    options = {"checkOnSave": False, "cargo": {"buildScripts": {"enable": True}}, "procMacro": {"enable": True}}
    server.ask("initialize", {
        "processId": None, "rootUri": folder.as_uri(), "capabilities": capabilities, "initializationOptions": options,
    })
    server.notify("initialized", {})
    return server


def ready(server):
    server.wait(lambda said: said.get("method") == "experimental/serverStatus" and said["params"]["quiescent"])


def check(condition, what):
    print(("ok      " if condition else "FAILED  ") + what)
    return condition


def main():
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        (folder / "src").mkdir()
        (folder / "Cargo.toml").write_text(MANIFEST)
        (folder / "src/main.rs").write_text(PROGRAM)
        server = started(folder)
        file = File(server, folder / "src/main.rs")
        ready(server)
        try:
            results = list(checks(file))
        finally:
            server.process.kill()
    sys.exit(0 if all(results) else 1)


def checks(file):
    whole = PROGRAM
    mark = whole.index(" /*here*/")
    yield check(not file.errors(), f"a description that is right: {file.errors()}")
    energy = whole.index("energy(motion")
    shown = file.hover(energy)
    yield check("fn energy(&self" in shown and "Energy T + V" in shown, f"hover on a generated method: {shown!r}")
    false = {}
    for length in range(1, len(TYPED) + 1):
        text = whole[:mark] + TYPED[:length] + whole[mark:]
        file.change(text)
        where = file.at(mark + length)["line"]
        # On the line itself the parser may miss something. Elsewhere nothing is wrong.
        errors = [f"{error['range']['start']['line'] + 1}: {error['message']}" for error in file.errors()
                  if error["range"]["start"]["line"] != where]
        if errors:
            false[TYPED[:length]] = errors
        if TYPED[:length].endswith("q."):
            found = file.completions(mark + length)
            yield check("theta" in found, f"behind `q.` stands a coordinate: {found[:5]}")
        if TYPED[:length].endswith("q.th"):
            found = file.completions(mark + length)
            yield check("theta" in found, f"and behind `q.th`: {found[:5]}")
            shown = file.hover(text.index("energy(motion"))
            yield check("fn energy" in shown, f"hover while a body is written: {shown[:200]!r}")
            found = file.completions(text.index("energy(motion"))
            yield check(any(label.startswith("mass_matrix") for label in found), "methods complete while a body is written")
    yield check(not false, f"no message elsewhere while somebody types: {false}")
    yield check(not file.errors(), "and none when all is written")


main()
