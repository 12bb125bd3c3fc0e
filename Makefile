# make demo, make check and make test need Debian 12 or 13, git and make; scripts/setup.sh installs the rest.

.PHONY: build demo lab check test test-full archive gpu-kit page three wasm python site single-header shaders hlsl-msl clean help

build: ## the programs, optimised, in build/release
	scripts/setup.sh build
	scripts/build.sh

demo: build ## a picture of a room: out/room.png and out/room.exr
	scripts/demo.sh

lab: build ## the program that repeats our measurements: build/release/apps/nusselt-lab/nusselt-lab
	scripts/build.sh nusselt_lab_app

check: ## the library and its tests, for this processor: the loop while editing
	scripts/setup.sh check
	scripts/test.sh check

test: ## builds and runs all tests and checks (docs/testing.md)
	scripts/setup.sh test
	scripts/test.sh

test-full: ## the same with full effort, and with other compilers and processors: hours
	scripts/setup.sh test
	NUSSELT_TEST_EFFORT=full scripts/test.sh full

archive: build ## the program for other x86-64 Linux systems: out/nusselt-*.tar.xz (docs/gpu-kit.md)
	scripts/pack.sh archive

gpu-kit: ## an archive that checks and measures the GPU of any machine: out/nusselt-gpu-kit.tar.xz (docs/gpu-kit.md)
	scripts/setup.sh build
	scripts/build.sh kit_programs
	scripts/pack.sh gpu-kit

site: page ## the documentation, the gallery, the live page and the report as pages for browsers: out/site
	scripts/setup.sh site
	scripts/build.sh apps/nusselt/all nusselt_lab_app
	site/make.sh

papers: ## our papers as PDF: out/papers (docs/papers)
	scripts/setup.sh site test
	scripts/papers/make.sh

page: ## the live page in one file: out/page/index.html (docs/page.md)
	scripts/setup.sh page
	web/build.py out/page/index.html

three: ## area lights with shadows for three.js, and an example: out/three (docs/three.md)
	scripts/setup.sh three
	web/build_three.py out/three

wasm: ## the library for JavaScript as an npm package: out/wasm (docs/wasm.md)
	scripts/setup.sh wasm
	scripts/build.sh nusselt_wasm
	cmake -E copy_directory build/release/wasm/package out/wasm

python: ## the library and the renderer for Python: a wheel in out/python (docs/python.md)
	scripts/setup.sh python
	/usr/bin/python3 python/nusselt_wheel.py out/python

single-header: ## the library in one file: out/nusselt.h (needs cmake only)
	cmake -D OUTPUT=out/nusselt.h -P scripts/amalgamate.cmake

shaders: ## each file of the GLSL, with what it includes, in one file: out/shaders/*.glsl (needs cmake only)
	cmake -D OUTPUT=out/shaders -P scripts/flatten-glsl.cmake

hlsl-msl: ## the techniques in HLSL and Metal Shading Language: out/hlsl, out/msl
	scripts/setup.sh hlsl
	scripts/build.sh build.ninja
	cmake -D LIST=build/release/lab/parity/shaders.txt -D OUTPUT=out -P scripts/convert-shaders.cmake

clean: ## removes build/ and out/
	rm -rf build out

help: ## this list
	@sed -nE 's/^([a-z-]+):[^#]*## (.*)/make \1\t\2/p' $(MAKEFILE_LIST)
