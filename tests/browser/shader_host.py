#!/usr/bin/env python3
"""Runs a test program that computes with the shaders of shaders/parity in WebGL 2. The program finds the number of a socket in
NUSSELT_SHADER_HOST and sends requests:

    shader NAME BYTES      and that many bytes: the words of the shader's table
    run SHADER CALLS BYTES and that many bytes: the inputs; SHADER counts the requests above

The answer to each is `ok BYTES` or `error BYTES`, a line, and that many bytes: the results, or what went wrong.

Usage: tests/browser/shader_host.py SHADERS FLATTENED PROGRAM [ARGUMENT...]
    SHADERS    the list of shaders that CMake writes: name, file and definitions, with tabs between them
    FLATTENED  the folder of flattened files, see tests/shaders/check_shaders.sh
Without chromium, chromium-driver or python3-selenium, the program runs without the socket; with CI=true in the environment,
that is a failure.
"""
import http.server
import json
import os
import pathlib
import queue
import socket
import subprocess
import sys
import threading

from es_shader import es_source

HERE = pathlib.Path(__file__).resolve().parent
PAGE = b"<!doctype html><meta charset=utf-8><title>Shaders</title><script src=/shader_host.js></script>"
TIMEOUT = 900  # seconds for an answer: shaders take 20 s to compile, and ten times as long where others keep the machine busy


class Exchange:
    """Requests for the page, and its answers."""

    def __init__(self, source):
        """source: function of the name of a shader that gives its text, or nothing if there is none."""
        self.source = source
        self.requests, self.answers = queue.Queue(), queue.Queue()

    def ask(self, request, data):
        self.requests.put((request, data))
        return self.answers.get(timeout=TIMEOUT)


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"  # one connection for all requests

    def reply(self, body, kind, headers=()):
        self.send_response(200)
        for name, value in (("Content-Type", kind), ("Content-Length", str(len(body))), *headers):
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def do_GET(self):
        if self.path == "/":
            self.reply(PAGE, "text/html")
        elif self.path == "/shader_host.js":
            self.reply((HERE / "shader_host.js").read_bytes(), "text/javascript")
        elif source := self.server.exchange.source(self.path.removeprefix("/shaders/")):
            self.reply(source.encode(), "text/plain")
        else:
            self.send_error(404)

    def do_POST(self):
        exchange = self.server.exchange
        body = self.rfile.read(int(self.headers["Content-Length"]))
        exchange.answers.put(("ok" if self.path == "/answer" else "error", body))
        request, data = exchange.requests.get()
        self.reply(data, "application/octet-stream", [("Request", json.dumps(request))])

    def log_message(self, *_):
        pass


def read_list(file):
    rows = (line.split("\t") for line in pathlib.Path(file).read_text().splitlines())
    return {name: (source, [define for define in defines if define]) for name, source, *defines in rows}


def serve(exchange, connection):
    """Passes on requests of the program until it ends, or until the page does not answer: then, the requests fail."""
    with connection, connection.makefile("rwb") as stream:
        while line := stream.readline():
            kind, *values, size = line.decode().split()
            data = stream.read(int(size))
            if kind == "shader":
                request = {"kind": kind, "name": values[0]}
            else:
                request = {"kind": kind, "shader": int(values[0]), "calls": int(values[1])}
            outcome, answer = exchange.ask(request, data)
            stream.write(f"{outcome} {len(answer)}\n".encode() + answer)
            stream.flush()


def main():
    shaders, flattened, *command = sys.argv[1:]
    try:
        from browser import WEBGL, Browser  # which ends here without python3-selenium
        browser = Browser((*WEBGL, "--disable-gpu-watchdog"))  # which would end what takes long
    except SystemExit:
        if os.environ.get("CI") == "true":
            raise
        os.execvp(command[0], command)
    recipes = read_list(shaders)
    exchange = Exchange(lambda name: name in recipes and es_source(*recipes[name], pathlib.Path(flattened)))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    server.daemon_threads = True
    server.exchange = exchange
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        browser.driver.get(f"http://127.0.0.1:{server.server_port}/")
        exchange.answers.get(timeout=TIMEOUT)  # the page asks for its first request
        ours, theirs = socket.socketpair()
        with subprocess.Popen(command, pass_fds=[theirs.fileno()],
                              env={**os.environ, "NUSSELT_SHADER_HOST": str(theirs.fileno())}) as program:
            theirs.close()
            serve(exchange, ours)
            return program.wait()
    except queue.Empty:
        print("the browser does not answer:", *browser.messages(), sep="\n", file=sys.stderr)
        return 1
    finally:
        browser.quit()


if __name__ == "__main__":
    sys.exit(main())
