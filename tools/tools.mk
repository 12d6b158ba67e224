# SPDX-License-Identifier: MIT
# The programs, each from a folder of its own. Their man pages lie beside them.

FLAGS_tools := -Itools

include tools/scene/scene.mk
include tools/hwgen/hwgen.mk
include tools/decode/decode.mk
include tools/info/info.mk
include tools/view/view.mk
include tools/vboard/vboard.mk
