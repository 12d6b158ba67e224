# SPDX-License-Identifier: MIT
# The virtual board: what stands in for a PCI board in a virtual machine.
