# SPDX-License-Identifier: MIT
# The ports: benches, and the comparison with their model.
