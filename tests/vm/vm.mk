# SPDX-License-Identifier: MIT
# Tests in a virtual machine: a Debian kernel, the module, and a virtual board.
