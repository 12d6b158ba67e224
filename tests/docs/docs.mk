# SPDX-License-Identifier: MIT
# What documents say, where a program can tell whether it is true.
##@ Documents

.PHONY: test-version test-links test-drawings test-docs test-guide print-version
test-version: ## one version everywhere: that of the file VERSION
	$(call quiet,TEST,version)
	$(Q)tests/docs/version

test-links: ## files and methods that documents name are there; 120 columns
	$(call quiet,TEST,links)
	$(Q)tests/docs/links

test-drawings: ## drawings name modules and signals that are there
	$(call quiet,TEST,drawings)
	$(Q)tests/docs/drawings docs/pictures/*.svg

# Documents whose commands are run.
CONSOLE_DOCS := docs/debugging-a-picture.md

test-docs: $(BUILD)/libaccel.so $(BUILD)/gloss-decode $(BUILD)/sim/accel-sim-t64-k8.so ## commands in documents print what stands there
	$(call quiet,TEST,docs)
	$(Q)tests/docs/console $(BUILD) $(CONSOLE_DOCS)

# In a copy of the tree, from which nothing is kept: a packet more, in the model, a core and the decoder.
test-guide: ## the guide that adds a packet, step by step, on a copy of the tree
	$(call quiet,TEST,docs/adding-a-packet.md)
	$(Q)tests/docs/console --copy $(BUILD)/guide $(BUILD) docs/adding-a-packet.md

.PHONY: pictures test-pictures
pictures: $(BUILD)/gloss-view ## draw the pictures of the documents anew
	$(Q)docs/pictures/make $< $(MODELS)

test-pictures: $(BUILD)/gloss-view ## the documents' pictures are what gloss-view draws
	$(call quiet,TEST,pictures)
	$(Q)if [ -e $(MODELS)/bunny.obj ] && [ -e $(MODELS)/horse.3ds ]; then \
		docs/pictures/make --check $< $(MODELS); \
	else \
		echo 'skip: no meshes in $(MODELS); install glmark2-data (make deps)'; \
	fi

print-version:
	@echo $(ACCEL_VERSION)

CHECKS += test-version test-links test-drawings test-docs test-guide test-pictures
