# SPDX-License-Identifier: MIT
# Any bytes as a stream: the model and the decoder under libFuzzer, which takes clang.
##@ Fuzzing

FUZZ_SECONDS ?= 60
FUZZ_RUNS    ?= 60000
FUZZ_CC      ?= clang
FUZZ_COMMON  := -g -O1 -fno-omit-frame-pointer -fno-sanitize-recover=all
FUZZ_FLAGS   = -max_len=4096 -timeout=$$((100 * $${GLOSS_SLOW:-1})) -error_exitcode=1 -print_final_stats=0 \
	-artifact_prefix=$(BUILD)/fuzz/

FLAGS_tests/fuzz := $(USB_CFLAGS)

# $(1): folder below $(BUILD)/fuzz, $(2): what clang builds into objects there
define fuzz_objects
FUZZ_CFLAGS_$(1) := $(FUZZ_COMMON) -fsanitize=$(2)
$$(BUILD)/fuzz/$(1)/%.o: %.c $$(BUILD)/flags
	$$(call compile,$$(FUZZ_CC),$$(FUZZ_CFLAGS_$(1)))
endef
# What is looked into; what makes up its world, which the fuzzer need not see; and frames.
$(eval $(call fuzz_objects,inside,fuzzer$(comma)address$(comma)undefined))
$(eval $(call fuzz_objects,world,address$(comma)undefined))
$(eval $(call fuzz_objects,draw,address$(comma)undefined$(comma)float-cast-overflow))

# Program $@ of the objects of folder $(1) and others.
define fuzz_link
	$(call quiet,LD,$@)
	$(Q)$(FUZZ_CC) $(FUZZ_CFLAGS_$(1)) $(filter %.o,$^) $(WRAPS) $(LIBS) -o $@
endef

FUZZ_PROGRAMS := $(BUILD)/fuzz/fuzz_stream $(BUILD)/fuzz/fuzz_corpus

$(BUILD)/fuzz/fuzz_stream: $(patsubst %.c,$(BUILD)/fuzz/inside/%.o,tests/fuzz/fuzz_stream.c \
		tools/decode/decode.c tools/decode/print.c $(MODEL_SOURCES))
	$(call fuzz_link,inside)

$(BUILD)/fuzz/fuzz_corpus: $(BUILD)/tests/fuzz/fuzz_corpus.o $(STREAM_RANDOM_OBJS)
	$(link)

# Runs fuzzer $(1) with $(2) on corpus $(3), which begins with what program $(4) makes of a seed. A
# failing input is left in $(BUILD)/fuzz; the fuzzer runs it alone if that is all it is given.
define fuzz_run
	$(Q)mkdir -p $(3)
	$(Q)seed=$${GLOSS_SEED:-$$(date +%s)}; echo "GLOSS_SEED=$$seed"; \
	$(BUILD)/fuzz/$(4) $(3) $$seed 200 && \
	$(BUILD)/fuzz/$(1) -seed=$$((seed % 4294967295)) $(2) $(FUZZ_FLAGS) $(3) \
		2>$(BUILD)/fuzz/$(1).log || { tail -n 60 $(BUILD)/fuzz/$(1).log; exit 1; }
	$(Q)tail -n 1 $(BUILD)/fuzz/$(1).log
endef

.PHONY: fuzz fuzz-short
fuzz: $(FUZZ_PROGRAMS) ## streams of any bytes to model and decoder, FUZZ_SECONDS=60
	$(call fuzz_run,fuzz_stream,-max_total_time=$(FUZZ_SECONDS),$(BUILD)/fuzz/corpus,fuzz_corpus)

fuzz-short: $(FUZZ_PROGRAMS)
	$(Q)rm -rf $(BUILD)/fuzz/short
	$(call fuzz_run,fuzz_stream,-runs=$(FUZZ_RUNS) -max_total_time=20,$(BUILD)/fuzz/short,fuzz_corpus)

CHECKS += fuzz-short
