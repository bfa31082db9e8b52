# Mammotwin's front door: `make help`.

DATA ?= sample_data
RESULTS ?= results
BIN := build/release/bin
# Taken as they stand: nothing in them is expanded by make, and recipes see them only as "$$P".
override P := $(value P)
override DATA := $(value DATA)
override RESULTS := $(value RESULTS)
export P DATA RESULTS FORCE BIN SEED
unexport MAKEFLAGS MAKEOVERRIDES

.PHONY: help patient segment fit compress register report synthesize build test clean
.DEFAULT_GOAL := help

help:
	@echo 'make patient P=042     MRI to lesion positions in CC and MLO, and a report'
	@echo 'make segment|fit|compress|register|report P=042'
	@echo '                       the same, up to and including that stage'
	@echo 'make synthesize P=name SEED=1   a synthetic patient in DATA/name'
	@echo 'make test              all tests'
	@echo 'make clean             removes build/ (results stay)'
	@echo
	@echo 'DATA=folder            of patient folders (default sample_data)'
	@echo 'RESULTS=folder         where results go (default results)'
	@echo 'FORCE=1                runs stages that are up to date, too'

patient segment fit compress register report: build
	@pipeline/run_patient.sh $@

build:
	@pipeline/install/ensure_packages.sh
	@test -f build/release/build.ninja || cmake --preset release
	@ninja -C build/release --quiet

test: build
	@ctest --test-dir build/release --output-on-failure -j2

clean:
	rm -rf build
