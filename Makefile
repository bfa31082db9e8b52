# Mammotwin's front door: `make help`.

DATA ?= sample_data
RESULTS ?= results
PREFIX ?= /usr/local
CASES ?= ../shared/cases
BIN := build/release/bin
# Taken as they stand: nothing in them is expanded by make, and recipes see them only as "$$P".
override P := $(value P)
override DATA := $(value DATA)
override RESULTS := $(value RESULTS)
override PATIENTS := $(value PATIENTS)
override JOBS := $(value JOBS)
override ONLY := $(value ONLY)
override FORCE := $(value FORCE)
override SEED := $(value SEED)
override PRESS := $(value PRESS)
override AXE := $(value AXE)
override ENGINE := $(value ENGINE)
override CONFIG := $(value CONFIG)
override PREFIX := $(value PREFIX)
override CASES := $(value CASES)
override SYNTHETIC := $(value SYNTHETIC)
override CHANGES := $(value CHANGES)
override VIEWS := $(value VIEWS)
override SPOIL := $(value SPOIL)
override MISFIT := $(value MISFIT)
override HARD := $(value HARD)
override FATTY := $(value FATTY)
override OTHERS := $(value OTHERS)
override TABLE := $(value TABLE)
override UNLOAD := $(value UNLOAD)
override MESHES := $(value MESHES)
override NUMBERS := $(value NUMBERS)
override ELEMENTS := $(value ELEMENTS)
ifeq ($(RESULTS),)
$(error RESULTS is empty: name the folder that results go to)
endif
export P DATA RESULTS FORCE BIN SEED PATIENTS JOBS ONLY ENGINE CONFIG PREFIX CASES SYNTHETIC CHANGES VIEWS SPOIL MISFIT HARD FATTY OTHERS TABLE UNLOAD PRESET PRESS AXE MESHES NUMBERS ELEMENTS PRESSURES EXAMS
unexport MAKEFLAGS MAKEOVERRIDES

.PHONY: help patient segment fit unload compress register report slicer paraview synthesize exam cohort verify-results \
        evaluate-segmentation evaluate-segmentation-changes evaluate-fitting evaluate-compression evaluate-coil evaluate-unload evaluate-gravity evaluate-registration \
        evaluate-stability evaluate-refinement evaluate-stabilisation evaluate-other-meshes evaluate-supine-spread evaluate-what-if evaluate-page evaluate-outlines evaluate-mammograms evaluate-mammogram-changes evaluate-tomosynthesis evaluate-real-pairs evaluate-strangers evaluate-niftysim evaluate-victre calibrate-tissue measured validate bench chain programs configured \
        configured_to_test install docs test clean
.NOTPARALLEL:  # ninja itself uses all cores
.DEFAULT_GOAL := help

help:
	@echo 'make patient P=042     MRI to lesion positions in CC and MLO, and a report'
	@echo 'make segment|fit|unload|compress|register|report P=042'
	@echo '                       the same, up to and including that stage'
	@echo 'make slicer P=042      the chain, and a scene for 3D Slicer: RESULTS/042/scene.mrml'
	@echo 'make paraview P=042    the chain, and each load step for ParaView: RESULTS/042/cc_course.pvd, mlo_course.pvd'
	@echo 'make synthesize P=name SEED=1   a synthetic patient in DATA/name'
	@echo 'make exam P=name SEED=42   a synthetic MRI series and mammograms, in DICOM, in DATA/name'
	@echo 'make cohort            every patient of DATA (or PATIENTS="042 043"): cohort.tsv, lesions.tsv, failed.tsv,'
	@echo '                       cohort.html; JOBS=4 at a time, ONLY=failed, ENGINE=slurm, CONFIG=file'
	@echo 'make verify-results P=042   are all files still those that were written?'
	@echo 'make evaluate-segmentation  segments SYNTHETIC=20 synthetic patients, and MRI simulated from the'
	@echo '                       label maps of CASES=folder: RESULTS/evaluation/segmentation.json; JOBS=2 at a time'
	@echo 'make evaluate-segmentation-changes CASES=folder   segments the MRI of its patients (folders with patient.toml)'
	@echo '                       again, mirrored, turned, in thick slices ...: RESULTS/evaluation/segmentation_changes.json'
	@echo 'make evaluate-fitting  fits every breast of CASES=folder, and SYNTHETIC=20 drawn ones:'
	@echo '                       RESULTS/evaluation/fitting.json; ONLY="Exam_02-left Exam_04"'
	@echo 'make evaluate-other-meshes OTHERS=folder   presses breasts with our meshes and with those of another'
	@echo '                       program: RESULTS/evaluation/other_meshes.json; VIEWS=cc'
	@echo 'make evaluate-gravity  lays every breast of CASES on its back: RESULTS/evaluation/gravity.json;'
	@echo '                       PRESET=real for another materials.preset; PRESS=1 presses them in CC, too'
	@echo 'make calibrate-tissue  finds the tissue with which the label maps of CASES do what women do from prone to'
	@echo '                       supine and need usual plate forces: RESULTS/evaluation/tissue_calibration.json;'
	@echo '                       ONLY="Exam_02 Exam_04", NUMBERS="materials.stiffness_factor", ELEMENTS=5x5x2'
	@echo 'make evaluate-supine-spread  how far landmarks of women go against their nipple as they lie back:'
	@echo '                       RESULTS/evaluation/supine_spread.json'
	@echo 'make evaluate-unload   takes gravity off every breast of CASES: RESULTS/evaluation/unload.json'
	@echo 'make evaluate-coil     drawn breasts imaged between the plates of a coil: RESULTS/evaluation/coil.json;'
	@echo '                       SYNTHETIC=10 of them from number FIRST=0, ROUNDNESS="0 0.8" of the breast let go'
	@echo 'make evaluate-compression   compresses SYNTHETIC=200 drawn breasts and those of CASES=folder in'
	@echo '                       both views: RESULTS/evaluation/compression.json; JOBS=2 at a time; UNLOADED=1: free of gravity;'
	@echo '                       VIEWS=cc'
	@echo 'make evaluate-stability  presses label maps and MRI of CASES again with their input changed in ways that must'
	@echo '                       not matter: RESULTS/evaluation/stability.json; ONLY="Exam_02-left Exam_04",'
	@echo '                       CHANGES="turn_5 mirror", VIEWS=cc, UNLOADED=1, TABLE=name (hours for all);'
	@echo '                       OTHER_PRESET=neo_hookean_2026: how far they move with the tissue of that name'
	@echo 'make evaluate-refinement  presses 042 and the real cases of CASES with coarser and finer meshes:'
	@echo '                       RESULTS/evaluation/refinement.json; ONLY=Exam_02-left; MESHES="16x16x3 9x9x2"'
	@echo 'make evaluate-stabilisation  presses 042 and the real cases of CASES with more and less of the term'
	@echo '                       that keeps the volume of each point: RESULTS/evaluation/stabilisation.json; ONLY=Exam_02-left'
	@echo 'make evaluate-registration  registers SYNTHETIC=10 patients with mammograms of another model:'
	@echo '                       RESULTS/evaluation/registration.json; JOBS=2 at a time; SPOIL=1: also told'
	@echo '                       wrongly of nipple, pectoral edge or abdomen (registration_spoilt.json); MISFIT=1: also'
	@echo '                       with mammograms of another breast or view (registration_misfit.json); HARD=1: patients'
	@echo '                       further from the model (registration_hard.json); FATTY=1: with next to no gland'
	@echo '                       (registration_fatty.json); PRESET=neo_hookean_2026: by a model of the tissue that they'
	@echo '                       are drawn with, not of the default one; how honest all ellipses are: *_ellipses.json'
	@echo 'make evaluate-tomosynthesis   registers 042 with tomosynthesis of another model: RESULTS/evaluation/tomosynthesis.json'
	@echo 'make evaluate-real-pairs CASES=folder   patients with lesions marked on mammograms (marks.csv):'
	@echo '                       RESULTS/evaluation/real_pairs.json'
	@echo 'make evaluate-strangers   registers real breasts of CASES with real mammograms of other women:'
	@echo '                       RESULTS/evaluation/strangers.json; ONLY=Exam_02-left; EXAMS=4 of them each'
	@echo 'make evaluate-what-if  what the sliders of the page say against full solves: RESULTS/evaluation/what_if.json; VIEWS=cc'
	@echo 'make evaluate-page     opens the pages of RESULTS in Chromium and moves their sliders: RESULTS/evaluation/page.json;'
	@echo '                       AXE=axe.min.js: checked by axe-core (npm), too'
	@echo 'make evaluate-mammograms CASES=folder   reads mammograms whose landmarks somebody read (landmarks.csv):'
	@echo '                       RESULTS/evaluation/mammograms.json and a contact sheet beside it'
	@echo 'make evaluate-mammogram-changes CASES=folder   the same, mirrored, resampled, turned, ...: mammogram_changes.json'
	@echo 'make evaluate-outlines   outlines of what RESULTS holds compressed in CC against those of real patients:'
	@echo '                       RESULTS/evaluation/outlines.json; PRESS=1 presses each to what is usual for its volume first'
	@echo 'make validate          the gel cylinder against other codes: RESULTS/gel_cylinder/validation.json;'
	@echo '                       the gel breast against its true skin: RESULTS/gel_breast/validation.json;'
	@echo '                       fits to known skins: RESULTS/evaluation/known_skins.json; fits by Ceres and otherwise:'
	@echo '                       RESULTS/evaluation/skin_slab_fits.json, stiffness_fits.json'
	@echo 'make evaluate-niftysim   a breast that NiftySim compressed, node by node: RESULTS/evaluation/niftysim.json'
	@echo 'make evaluate-victre   a phantom that FEBio compressed, its outline and tissue: RESULTS/evaluation/victre.json'
	@echo 'make measured          the pages of docs/measured, from what evaluations wrote into RESULTS'
	@echo 'make bench             times of kernels, linear algebra and whole solves (ten minutes):'
	@echo '                       RESULTS/evaluation/benchmarks.json'
	@echo 'make install PREFIX=/usr/local   programs, manual pages, completion, libraries'
	@echo 'make docs              tutorial, how-tos, theory, reference: build/release/docs/index.html'
	@echo 'make test              all tests'
	@echo 'make clean             removes build/ (results stay)'
	@echo
	@echo 'KEEP=1                 of evaluate-compression, -stability, -gravity and -strangers: rows of other breasts stay, so that'
	@echo '                       a table can be made in parts (FIRST=40 SYNTHETIC=20: drawn breasts 40 to 59)'
	@echo 'DATA=folder            of patient folders (default sample_data)'
	@echo 'RESULTS=folder         where results go (default results)'
	@echo 'FORCE=1                runs stages that are up to date, too'

# A target builds the programs that it runs: `chain` are those of the stages.
patient segment fit unload compress register report: chain
slicer: chain mammotwin-slicer
paraview: chain mammotwin-paraview
synthesize: mammotwin-synthesize
exam: mammotwin-synthesize-exam
cohort: chain mammotwin-cohort
verify-results: mammotwin-verify
validate: mammotwin-validate mammotwin-validate-gel-breast mammotwin-validate-known-skins mammotwin-validate-other-fits
patient segment fit unload compress register report slicer paraview synthesize exam:
	@pipeline/run_patient.sh $@

cohort:
	@pipeline/cohort/run_cohort.sh

evaluate-segmentation: mammotwin-evaluate-segmentation
	@"$$BIN/mammotwin-evaluate-segmentation" "$$RESULTS/evaluation/segmentation.json" --cases "$$CASES" \
	  $${SYNTHETIC:+--synthetic "$$SYNTHETIC"} $${JOBS:+--jobs "$$JOBS"} $${ONLY:+--only $$ONLY}

evaluate-segmentation-changes: mammotwin-evaluate-segmentation-changes
	@"$$BIN/mammotwin-evaluate-segmentation-changes" "$$CASES" "$$RESULTS/evaluation/segmentation_changes.json" \
	  $${ONLY:+--only $$ONLY} $${JOBS:+--jobs "$$JOBS"}

evaluate-fitting: mammotwin-evaluate-fitting
	@"$$BIN/mammotwin-evaluate-fitting" "$$CASES" "$$RESULTS/evaluation/fitting.json" \
	  $${SYNTHETIC:+--synthetic "$$SYNTHETIC"} $${ONLY:+--only $$ONLY}

evaluate-unload: mammotwin-evaluate-unload
	@"$$BIN/mammotwin-evaluate-unload" "$$CASES" "$$RESULTS/evaluation/unload.json" --views

evaluate-coil: mammotwin-evaluate-coil
	@"$$BIN/mammotwin-evaluate-coil" "$$RESULTS/evaluation/coil.json" \
	  $${SYNTHETIC:+--synthetic "$$SYNTHETIC"} $${FIRST:+--first "$$FIRST"} $${ROUNDNESS:+--roundness $$ROUNDNESS} $${JOBS:+--jobs "$$JOBS"}

evaluate-supine-spread: mammotwin-evaluate-supine-spread
	@"$$BIN/mammotwin-evaluate-supine-spread" "$$CASES" "$$RESULTS/evaluation/supine_spread.json"

evaluate-gravity: mammotwin-evaluate-gravity
	@set -f; for option in $$UNLOAD; do set -- "$$@" "--unload=$$option"; done; \
	  "$$BIN/mammotwin-evaluate-gravity" "$$CASES" "$$RESULTS/evaluation/$${TABLE:-gravity}.json" \
	  $${JOBS:+--jobs "$$JOBS"} $${ONLY:+--only $$ONLY} $${KEEP:+--keep} $${PRESET:+--preset "$$PRESET"} \
	  $${PRESS:+--population "$$CASES/compressed_outlines"} "$$@"

calibrate-tissue: mammotwin-calibrate-tissue
	@set -f; "$$BIN/mammotwin-calibrate-tissue" "$$CASES" "$$RESULTS/evaluation/tissue_calibration.json" \
	  $${JOBS:+--jobs "$$JOBS"} $${ONLY:+--only $$ONLY} $${NUMBERS:+--numbers $$NUMBERS} $${ELEMENTS:+--elements "$$ELEMENTS"}

evaluate-compression: mammotwin-evaluate-compression
	@"$$BIN/mammotwin-evaluate-compression" "$$RESULTS/evaluation/$${TABLE:-compression}.json" --cases "$$CASES" \
	  $${SYNTHETIC:+--synthetic "$$SYNTHETIC"} $${FIRST:+--first "$$FIRST"} $${JOBS:+--jobs "$$JOBS"} \
	  $${ONLY:+--only $$ONLY} $${KEEP:+--keep} $${PRESET:+--preset "$$PRESET"} $${UNLOADED:+--unloaded} \
	  $${VIEWS:+--views $$VIEWS}

evaluate-stability: mammotwin-evaluate-stability
	@"$$BIN/mammotwin-evaluate-stability" "$$CASES" "$$RESULTS/evaluation/$${TABLE:-stability}.json" \
	  $${ONLY:+--only $$ONLY} $${UNLOADED:+--unloaded} $${CHANGES:+--changes $$CHANGES} $${OTHER_PRESET:+--other-preset "$$OTHER_PRESET"} \
	  $${VIEWS:+--views $$VIEWS} $${JOBS:+--jobs "$$JOBS"} $${KEEP:+--keep}

evaluate-refinement: mammotwin-evaluate-refinement
	@"$$BIN/mammotwin-evaluate-refinement" sample_data/042/patient.toml "$$CASES" \
	  "$$RESULTS/evaluation/refinement.json" $${ONLY:+--only $$ONLY} $${MESHES:+--meshes $$MESHES}

evaluate-stabilisation: mammotwin-evaluate-stabilisation
	@"$$BIN/mammotwin-evaluate-stabilisation" sample_data/042/patient.toml "$$CASES" \
	  "$$RESULTS/evaluation/stabilisation.json" $${ONLY:+--only $$ONLY}

evaluate-other-meshes: mammotwin-evaluate-other-meshes
	@"$$BIN/mammotwin-evaluate-other-meshes" sample_data/042/patient.toml "$$CASES" "$$OTHERS" \
	  "$$RESULTS/evaluation/other_meshes.json" $${VIEWS:+--views $$VIEWS}

evaluate-registration: mammotwin-evaluate-registration
	@"$$BIN/mammotwin-evaluate-registration" "$$RESULTS/evaluation/registration$${HARD:+_hard}$${FATTY:+_fatty}$${SPOIL:+_spoilt}$${MISFIT:+_misfit}$${PRESET:+_$$PRESET}.json" \
	  $${SYNTHETIC:+--synthetic "$$SYNTHETIC"} $${JOBS:+--jobs "$$JOBS"} $${SPOIL:+--spoil} $${MISFIT:+--misfit} $${HARD:+--hard} $${FATTY:+--fatty} \
	  $${PRESET:+--preset "$$PRESET"}

evaluate-tomosynthesis: mammotwin-evaluate-tomosynthesis
	@"$$BIN/mammotwin-evaluate-tomosynthesis" "$$RESULTS/evaluation/tomosynthesis.json"

evaluate-real-pairs: mammotwin-evaluate-real-pairs
	@"$$BIN/mammotwin-evaluate-real-pairs" "$$CASES" "$$RESULTS/evaluation/real_pairs.json"

evaluate-strangers: mammotwin-evaluate-strangers
	@"$$BIN/mammotwin-evaluate-strangers" "$$CASES" "$$RESULTS/evaluation/strangers.json" \
	  $${ONLY:+--only $$ONLY} $${EXAMS:+--exams "$$EXAMS"} $${JOBS:+--jobs "$$JOBS"} $${KEEP:+--keep}

evaluate-what-if: mammotwin-evaluate-what-if
	@"$$BIN/mammotwin-evaluate-what-if" sample_data/042/patient.toml "$$CASES" "$$RESULTS/evaluation/what_if.json" \
	  $${ONLY:+--only $$ONLY} $${VIEWS:+--views $$VIEWS}

evaluate-page: mammotwin-evaluate-page
	@"$$BIN/mammotwin-evaluate-page" "$$RESULTS/evaluation/page.json" $${AXE:+--axe "$$AXE"} $$(find -L "$$RESULTS" -maxdepth 2 -name report.html | sort)

evaluate-mammograms: mammotwin-evaluate-mammograms
	@"$$BIN/mammotwin-evaluate-mammograms" "$$(test -f "$$CASES/landmarks.csv" && echo "$$CASES" || echo "$$CASES/real_mammograms")" \
	  "$$RESULTS/evaluation/mammograms.json"

evaluate-mammogram-changes: mammotwin-evaluate-mammogram-changes
	@"$$BIN/mammotwin-evaluate-mammogram-changes" "$$(test -f "$$CASES/landmarks.csv" && echo "$$CASES" || echo "$$CASES/real_mammograms")" \
	  "$$RESULTS/evaluation/mammogram_changes.json"

evaluate-outlines: mammotwin-evaluate-outlines
	@"$$BIN/mammotwin-evaluate-outlines" "$$CASES/compressed_outlines" "$$RESULTS/evaluation/outlines.json" \
	  $$(test -d "$$CASES/real_mammograms" && echo --mammograms "$$CASES/real_mammograms") \
	  $${PRESS:+--press} $$(find -L "$$RESULTS" -name cc.vtu -not -path '*/evaluation/outlines/*' | sort)

validate:
	@"$$BIN/mammotwin-validate" sample_data/gel_cylinder "$$RESULTS/gel_cylinder/validation.json"
	@"$$BIN/mammotwin-validate-gel-breast" sample_data/gel_breast/scan.ply "$$RESULTS/gel_breast/validation.json"
	@"$$BIN/mammotwin-validate-known-skins" sample_data/gel_breast/scan.ply "$$RESULTS/evaluation/known_skins.json"
	@"$$BIN/mammotwin-validate-other-fits" "$$RESULTS/evaluation"

evaluate-niftysim: mammotwin-evaluate-niftysim
	@"$$BIN/mammotwin-evaluate-niftysim" "$$CASES/breast_ct_compression" "$$RESULTS/evaluation/niftysim.json"

evaluate-victre: mammotwin-evaluate-victre
	@"$$BIN/mammotwin-evaluate-victre" "$$CASES/victre" "$$RESULTS/evaluation/victre.json"

measured: mammotwin-measured
	@"$$BIN/mammotwin-measured" docs/measured --evaluation "$$RESULTS/evaluation"

bench: configured_to_test
	@pipeline/install/build.sh solver_benchmarks
	@"$$BIN/solver_benchmarks" "$$RESULTS/evaluation/benchmarks.json"

verify-results:
	@pipeline/cohort/verify_patient.sh

chain programs: configured
	@pipeline/install/build.sh $@

mammotwin-%: configured
	@pipeline/install/build.sh $@

configured:
	@pipeline/install/ensure_packages.sh
	@pipeline/install/configure.sh

# Tests and benchmarks take some packages more, so does the documentation.
configured_to_test:
	@pipeline/install/ensure_packages.sh debian_packages.txt debian_packages_develop.txt
	@pipeline/install/configure.sh -D MAMMOTWIN_TESTS=ON

docs:
	@pipeline/install/ensure_packages.sh debian_packages.txt debian_packages_docs.txt
	@pipeline/install/configure.sh
	@cmake build/release >/dev/null  # finds what was just installed
	@pipeline/install/build.sh site

test: configured_to_test
	@pipeline/install/build.sh all
	@ctest --test-dir build/release --output-on-failure -j2

install: configured
	@pipeline/install/build.sh all
	@cmake --install build/release --prefix "$$PREFIX"

clean:
	rm -rf build
