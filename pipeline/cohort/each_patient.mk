# One target a patient; make -k -j N is the whole scheduler. Names are plain (run_cohort.sh), and the
# prefix keeps a patient from being called like a file or a rule.
patients := $(addprefix patient/,$(file < $(LIST)))

.PHONY: all $(patients)
all: $(patients)
$(patients):
	@exec "$${COHORT_HERE}/one_patient.sh" $(@F)
