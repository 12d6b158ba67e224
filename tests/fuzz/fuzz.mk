# SPDX-License-Identifier: MIT
# Any bytes as a stream: the model and the decoder under libFuzzer, which takes clang.

FUZZ_SECONDS ?= 60
FUZZ_RUNS    ?= 60000
FUZZ_CC      ?= clang
FUZZ_CFLAGS  := -g -O1 -fno-omit-frame-pointer -fsanitize=fuzzer,address,undefined \
	-fno-sanitize-recover=all
FUZZ_SOURCES := tests/fuzz/fuzz_stream.c tools/decode.c tools/decode_print.c $(MODEL_SOURCES)
FUZZ_PROGRAMS := $(BUILD)/fuzz/fuzz_stream $(BUILD)/fuzz/fuzz_corpus
FUZZ_FLAGS   = -max_len=4096 -timeout=10 -error_exitcode=1 -print_final_stats=0 \
	-artifact_prefix=$(BUILD)/fuzz/

$(BUILD)/fuzz/fuzz_stream: $(FUZZ_SOURCES) tests/fuzz/fuzz_input.h tools/gloss_table.h \
		$(wildcard libaccel/model/*.h)
	$(call quiet,CC,$@)
	@mkdir -p $(@D)
	$(Q)$(FUZZ_CC) $(ACCEL_CFLAGS) -Itools -Itests/stream $(FUZZ_CFLAGS) $(FUZZ_SOURCES) -o $@

$(BUILD)/fuzz/fuzz_corpus: tests/fuzz/fuzz_corpus.c tests/fuzz/fuzz_input.h $(STREAM_RANDOM_OBJS)
	$(call quiet,CC,$@)
	@mkdir -p $(@D)
	$(Q)$(CC) $(ACCEL_CFLAGS) -Itests/stream $(CFLAGS) $< $(STREAM_RANDOM_OBJS) -o $@

# Runs the fuzzer with $(1) on corpus $(2), which begins with random jobs of the same seed. A
# failing input is left in $(BUILD)/fuzz; `fuzz_stream FILE` runs it alone.
define fuzz_run
	$(Q)mkdir -p $(2)
	$(Q)seed=$${GLOSS_SEED:-$$(date +%s)}; echo "GLOSS_SEED=$$seed"; \
	$(BUILD)/fuzz/fuzz_corpus $(2) $$seed 200 && \
	$(BUILD)/fuzz/fuzz_stream -seed=$$((seed % 4294967295)) $(1) $(FUZZ_FLAGS) $(2) \
		2>$(BUILD)/fuzz/log || { tail -n 60 $(BUILD)/fuzz/log; exit 1; }
	$(Q)tail -n 1 $(BUILD)/fuzz/log
endef

.PHONY: fuzz fuzz-short
fuzz: $(FUZZ_PROGRAMS) ## streams of any bytes to model and decoder, FUZZ_SECONDS=60
	$(call fuzz_run,-max_total_time=$(FUZZ_SECONDS),$(BUILD)/fuzz/corpus)

fuzz-short: $(FUZZ_PROGRAMS)
	$(Q)rm -rf $(BUILD)/fuzz/short
	$(call fuzz_run,-runs=$(FUZZ_RUNS) -max_total_time=20,$(BUILD)/fuzz/short)

CHECKS += fuzz-short
