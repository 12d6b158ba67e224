# SPDX-License-Identifier: MIT
# Any bytes as a stream: the model and the decoder under libFuzzer, which takes clang.

FUZZ_SECONDS ?= 60
FUZZ_RUNS    ?= 60000
FUZZ_CC      ?= clang
FUZZ_CFLAGS  := -g -O1 -fno-omit-frame-pointer -fsanitize=fuzzer,address,undefined \
	-fno-sanitize-recover=all
FUZZ_SOURCES := tests/fuzz/fuzz_stream.c tools/decode/decode.c tools/decode/print.c $(MODEL_SOURCES)
FUZZ_PROGRAMS := $(BUILD)/fuzz/fuzz_stream $(BUILD)/fuzz/fuzz_corpus
FUZZ_FLAGS   = -max_len=4096 -timeout=$$((100 * $${GLOSS_SLOW:-1})) -error_exitcode=1 -print_final_stats=0 \
	-artifact_prefix=$(BUILD)/fuzz/

$(BUILD)/fuzz/fuzz_stream: $(FUZZ_SOURCES) tests/fuzz/fuzz_input.h tools/decode/gloss_table.h \
		$(wildcard libaccel/model/*.h)
	$(call quiet,CC,$@)
	@mkdir -p $(@D)
	$(Q)$(FUZZ_CC) $(ACCEL_CFLAGS) -Itools -Itests/stream $(FUZZ_CFLAGS) $(FUZZ_SOURCES) -o $@

$(BUILD)/fuzz/fuzz_corpus: tests/fuzz/fuzz_corpus.c tests/fuzz/fuzz_input.h $(STREAM_RANDOM_OBJS)
	$(call quiet,CC,$@)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Itests/stream $(CFLAGS) $< $(STREAM_RANDOM_OBJS) -o $@

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
