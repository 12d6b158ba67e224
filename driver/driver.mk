# SPDX-License-Identifier: MIT
# The kernel module gloss.ko.
