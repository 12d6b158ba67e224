# SPDX-License-Identifier: MIT
# Figures. A benchmark is a target that writes "name value" lines to build/bench/NAME.txt and is
# added to BENCHES; they run one after the other. docs/figures.md says what each name means.
##@ Pictures and figures

BENCH_PROGRAMS := $(addprefix $(BUILD)/tests/bench/, bench_load bench_record bench_setup \
	bench_shade)
BENCHES += bench-frame bench-growth bench-shade bench-setup bench-record bench-load nmse

# SHORT=1: one round of what compares with Mesa, to try it out; then no aim counts.
SHORT ?= 0
SHORT_OPTION := $(if $(filter-out 0,$(SHORT)),--short)

FLAGS_tests/bench := $(SCENE_CFLAGS)
$(BENCH_PROGRAMS): private LIBS := $(SCENE_LIBS)
$(BENCH_PROGRAMS): $(SCENE_OBJS) $(BUILD)/libaccel.a

# Those that compare with Mesa, which libepoxy opens at run time.
CONTEST_OBJS := $(addprefix $(BUILD)/tests/bench/, contest.o contest_picture.o gl_context.o gl_scene.o \
	painter.o painter_gl.o painter_own.o)
CONTEST_PROGRAMS := $(addprefix $(BUILD)/tests/bench/, bench_frame bench_growth)
$(CONTEST_PROGRAMS): private LIBS := $(SCENE_LIBS) -lepoxy -ldl
$(CONTEST_PROGRAMS): $(CONTEST_OBJS) $(SCENE_OBJS) $(BUILD)/libaccel.a

# Those that draw what gloss-view draws.
SUBJECT_OBJS := $(BUILD)/tests/bench/subject.o $(addprefix $(BUILD)/tools/view/, camera.o draw.o light.o \
	material.o number.o options.o progress.o)
$(CONTEST_PROGRAMS) $(addprefix $(BUILD)/tests/bench/, bench_record bench_setup): $(SUBJECT_OBJS)

# What a benchmark prints is shown and kept, also if it fails: a figure that misses its aim is one.
keep_figures = mkdir -p $(BUILD)/bench && { tests/bench/retry $(BUILD)/bench/$(1).txt $(2); status=$$?; } && \
	cat $(BUILD)/bench/$(1).txt && exit $$status

.PHONY: bench bench-frame bench-growth bench-load bench-record bench-shade bench-setup figures frame-pictures plot \
	test-plot run-bench-figures run-bench-run run-merge run-test_painter
bench-frame: $(BUILD)/tests/bench/bench_frame ## frames a processor second against Mesa's drivers (SHORT=1: one round)
	$(Q)$(call keep_figures,frame,$< $(SHORT_OPTION) $(MODELS))

bench-growth: $(BUILD)/tests/bench/bench_growth ## the same by the size of triangles, their number, and pixels (SHORT=1)
	$(Q)$(call keep_figures,growth,$< $(SHORT_OPTION))

frame-pictures: $(BUILD)/tests/bench/bench_frame ## bench-frame compares ways that draw the same pictures
	$(call quiet,TEST,frame pictures)
	$(Q)$< --pictures $(MODELS)

CHECKS += frame-pictures

bench-shade: $(BUILD)/tests/bench/bench_shade ## speed of the model against per-pixel Phong
	$(Q)$(call keep_figures,shade,$< sphere:2 sphere:3 torus:24 $(MODELS)/bunny.obj)

bench-setup: $(BUILD)/tests/bench/bench_setup ## triangles set up a second, and their words
	$(Q)$(call keep_figures,setup,$< $(MODELS))

bench-record: $(BUILD)/tests/bench/bench_record $(SIM_DIR)/accel-sim-t64-k8.so ## clocks of the core for a mesh's record
	$(Q)$(call keep_figures,record,env GLOSS_SIM_PATH=$(SIM_DIR) $< $(MODELS))

bench-load: $(BUILD)/tests/bench/bench_load ## time and memory of reading a mesh against assimp alone
	$(Q)$(call keep_figures,load,$<)

bench: ## all figures, also if a part fails, in build/bench.json; with those of make synth if it has run
	$(Q)+tests/bench/run $(BUILD) docs/figures.md $(BENCHES)

# Also what there is of a run in which a part failed.
figures: nmse-table ## run make bench, put its ratios and counts into docs/figures.md, and draw them
	$(Q)+$(MAKE) --no-print-directory bench; status=$$?; \
	tests/bench/figures $(BUILD)/bench.json docs/figures.md && $(MAKE) --no-print-directory plot && exit $$status

plot: ## draw the main figures of docs/figures.md anew
	$(Q)tests/bench/plot docs/figures.md docs/pictures/speed.svg

test-plot: ## the drawing of figures is of those in docs/figures.md
	$(call quiet,TEST,plot)
	$(Q)tests/bench/plot --check docs/figures.md docs/pictures/speed.svg

CHECKS += test-plot

run-merge:
	$(call quiet,TEST,merge)
	$(Q)tests/bench/test_merge.sh $(BUILD)/tests/bench/merge

run-bench-run:
	$(call quiet,TEST,bench/run)
	$(Q)tests/bench/test_run.sh $(BUILD)/tests/bench/run

$(BUILD)/tests/bench/test_painter: private LIBS := -lcmocka $(SCENE_LIBS) -lepoxy -ldl
$(BUILD)/tests/bench/test_painter: $(CONTEST_OBJS) $(SCENE_OBJS) $(BUILD)/libaccel.a
run-test_painter: $(BUILD)/tests/bench/test_painter
	$(call quiet,TEST,test_painter)
	$(Q)$<

run-bench-figures:
	$(call quiet,TEST,bench/figures)
	$(Q)tests/bench/test_figures.sh $(BUILD)/tests/bench/figures

UNIT_TESTS += merge bench-run bench-figures test_painter
