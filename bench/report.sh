# SPDX-FileCopyrightText: The Orbweave authors
# SPDX-License-Identifier: BSD-3-Clause
#
# What scripts of this folder read of a job: sourced, with `folder` set; its report is in
# $folder/out.

# A number of report.json's outermost object.
field() { sed -n "s/^ \"$1\": \([^,]*\),*$/\1/p" "$folder/out/report.json" | head -1; }

# The verdict, with its reasons.
verdict() { sed -n '/^ "verdict": {/,/^ }/p' "$folder/out/report.json"; }

# How good it is: good, doubtful or bad.
level() { verdict | sed -n 's/^  "level": "\(.*\)",*$/\1/p'; }
