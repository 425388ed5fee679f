// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/slurm/slurm_scripts.h"

#include <algorithm>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "cli/process/exit_code.h"
#include "core/base/digest.h"

namespace orbweave {
namespace {

/// What both scripts say to Slurm, and what `own` says for one of them.
std::string Header(const SlurmLaunch& launch,
                   const std::vector<std::string>& own,
                   const std::string& name,
                   const std::string& log) {
  std::string header = absl::StrCat(
      "#!/bin/bash\n#SBATCH --job-name=",
      ShellWord(name),
      "\n#SBATCH --chdir=",
      ShellWord(launch.work_folder),
      "\n#SBATCH --output=",
      ShellWord(absl::StrCat(absl::StrReplaceAll(launch.Folder(), {{"%", "%%"}}), "/", log)),
      "\n#SBATCH --open-mode=append\n#SBATCH --nodes=1\n"
      "#SBATCH --ntasks=1\n#SBATCH --requeue\n"
      "#SBATCH --signal=B:TERM@60\n");
  if (!launch.time.empty()) absl::StrAppend(&header, "#SBATCH --time=", launch.time, "\n");
  for (const auto* options : {&launch.sbatch, &own})
    for (const std::string& option : *options) absl::StrAppend(&header, "#SBATCH ", option, "\n");
  return header;
}

/// Of an array SLURM_JOB_ID may name all jobs at once.
constexpr const char* kOwnId =
    R"sh(me=${SLURM_ARRAY_JOB_ID:+${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID}
me=${me:-$SLURM_JOB_ID}
)sh";

/// Until when this allocation lasts, in seconds since 1970; nothing where Slurm does not know.
constexpr const char* kEndTime = R"sh(end_time() {
  local end
  end=$(scontrol show job --oneliner "$me" | grep -o ' EndTime=[0-9][^ ]*' | cut -d= -f2)
  [ -z "$end" ] || date -d "$end" +%s
}
)sh";

/// SIGTERM comes a minute before the end. Workers whose time is up too hand in what they have
/// meanwhile, so the coordinator stays for most of that minute. Who is preempted has less, or more
/// than Slurm says: then it goes at once.
constexpr const char* kHandOnLate = R"sh(hand_on() {
  local left
  left=$(end_time)
  left=$((${left:-0} - $(date +%s) - 15))
  if [ $left -gt 0 ] && [ $left -le 60 ]; then
    while [ $((left--)) -gt 0 ] && kill -0 $child 2>/dev/null; do sleep 1; done
  fi
  kill -TERM $child 2>/dev/null
}
)sh";
constexpr const char* kHandOn = R"sh(hand_on() { kill -TERM $child 2>/dev/null; }
)sh";

/// Waits for the process $child, hands one SIGTERM on to it (hand_on), and has Slurm start the
/// script again when the process says that there is more to do. Not when somebody cancelled the
/// job. Leaves the exit code in $code.
std::string WaitOrRequeue() {
  return absl::StrCat(R"sh(trap 'trap "" TERM; hand_on' TERM
wait $child
code=$?
wait $child 2>/dev/null  # the first may have ended by the signal
again=$?
[ $again -eq 127 ] || code=$again
state() { squeue --noheader --format=%T --jobs="$me" || { sleep 5; squeue --noheader --format=%T --jobs="$me"; }; }
if [ $code -eq )sh",
                      static_cast<int>(kExitStopped),
                      R"sh( ] && [ "$(state 2>/dev/null)" = RUNNING ]; then
  trap - TERM
  [ -z "${scratch:-}" ] || rm -rf "$scratch"
  scontrol requeue "$me" && sleep 300  # until Slurm ends this script
fi
)sh");
}

}  // namespace

std::string NameInQueue(const std::string& name) {
  std::string plain = name;
  for (char& c : plain) {
    if (!absl::ascii_isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
  }
  return "orbweave-" + plain;
}

std::string SlurmLaunch::WorkersName() const {
  return absl::StrCat(name, "-worker-", DigestOf(output).ToShortHex());
}

bool SlurmLaunch::HasStore() const {
  return std::ranges::any_of(run_arguments, [](const std::string& argument) {
    return argument == "--store" || argument.starts_with("--store=");
  });
}

std::string ShellWord(const std::string& text) {
  return absl::StrCat("'", absl::StrReplaceAll(text, {{"'", "'\\''"}}), "'");
}

std::string ShellWordWithNames(const std::string& text) {
  std::string word = "\"";
  for (size_t i = 0; i < text.size(); ++i) {
    const char next = i + 1 < text.size() ? text[i + 1] : ' ';
    const bool is_name =
        next == '{' || next == '_' || absl::ascii_isalpha(static_cast<unsigned char>(next));
    if (text[i] == '"' || text[i] == '`' || text[i] == '\\' || (text[i] == '$' && !is_name))
      word += '\\';
    word += text[i];
  }
  return word + "\"";
}

std::string CoordinatorScript(const SlurmLaunch& launch) {
  std::string arguments;
  for (const auto* words : {&launch.command, &launch.run_arguments}) {
    for (const std::string& word : *words) absl::StrAppend(&arguments, " ", ShellWord(word));
  }
  return absl::StrCat(
      Header(launch, launch.coordinator_sbatch, launch.name, "coordinator.log"),
      "#SBATCH --cpus-per-task=1\n\n",
      kOwnId,
      kEndTime,
      kHandOnLate,
      "launch=",
      ShellWord(launch.Folder()),
      "\nname=",
      ShellWord(launch.WorkersName()),
      "\nfewest=",
      launch.min_nodes,
      "\nmost=",
      launch.max_nodes,
      "\ncpus=",
      launch.cpus,
      "\nprogram=",
      ShellWord(launch.program),
      R"sh(

rm -f "$launch/refused"

# How many workers there should be: as there is work for, within bounds.
target() {
  local slots nodes=$fewest
  if [ $most -gt $fewest ] && slots=$("$program" status --coordinator "@$launch/coordinator.json" \
    --tls "$launch/keys/client" --wanted 2>/dev/null); then
    nodes=$(((slots + cpus - 1) / cpus))
  fi
  [ $nodes -ge $fewest ] || nodes=$fewest
  [ $nodes -le $most ] || nodes=$most
  echo $nodes
}

# submit COUNT [OPTION...]
submit() {
  local count=$1
  shift
  [ $count -le 0 ] || sbatch --parsable "$@" --array=1-$count "$launch/workers.sbatch"
}

# Workers that are missing in the queue: all at first, later those whose node was lost or who gave up.
# submit_missing COUNT: so many there should be. Fails when workers cannot work. Says in $skip for how many
# looks none are to be submitted: for a minute, or longer each time that Slurm takes none.
skip=0
pause=1
submit_missing() {
  local known
  known=$(squeue --noheader --array --me --name="$name") || return 0
  if [ "$(cat "$launch/refused" 2>/dev/null | wc -l)" -ge $((3 * most)) ]; then
    echo "workers end as soon as they are started: see $launch/worker-*.log" >&2
    kill -INT $child
    return 1
  fi
  known=$(grep -c . <<<"$known")
  local stay=$((fewest - known))
  [ $stay -gt 0 ] || stay=0
  [ $1 -gt $known ] || [ $stay -gt 0 ] || return 0
  skip=1
  if submit $stay && submit $(($1 - known - stay)) --export=ALL,ORBWEAVE_IDLE_EXIT=120; then
    pause=1
  else
    pause=$((pause < 16 ? 2 * pause : 32))
    skip=$((pause - 1))
  fi
}

submit_missing $fewest
"$program")sh",
      arguments,
      " --output ",
      ShellWord(launch.output),
      R"sh( \
  --workers 0 --listen 0.0.0.0:0 --tls "$launch/keys/coordinator" --announce "$launch/coordinator.json" \
  --journal-folder )sh",
      launch.journal_folder.empty() ? "\"${TMPDIR:-/tmp}\"" : ShellWord(launch.journal_folder),
      R"sh( &
child=$!
while sleep 30; do
  if [ $skip -gt 0 ]; then skip=$((skip - 1)); else submit_missing "$(target)" || break; fi
done &
keeper=$!
)sh",
      WaitOrRequeue(),
      R"sh(kill $keeper 2>/dev/null
scancel --quiet --me --state=PENDING --name="$name"
exit $code
)sh");
}

std::string WorkersScript(const SlurmLaunch& launch) {
  return absl::StrCat(
      Header(launch, launch.workers_sbatch, launch.WorkersName(), "worker-%A_%a.log"),
      "#SBATCH --cpus-per-task=",
      launch.cpus,
      "\n\n",
      kOwnId,
      kEndTime,
      kHandOn,
      "launch=",
      ShellWord(launch.Folder()),
      R"sh(
scratch=$(mktemp -d "${TMPDIR:-/tmp}/orbweave-XXXXXX") || exit
trap 'rm -rf "$scratch"' EXIT
# SIGTERM comes a minute before the end; tasks then have what is left of it, but for a moment to give back.
until=$(end_time)
[ -z "$until" ] || until=$((until - 10))
memory=${SLURM_MEM_PER_NODE:-$((${SLURM_MEM_PER_CPU:-0} * ${SLURM_CPUS_PER_TASK:-1}))}
[ "$memory" -gt 0 ] || memory=

)sh",
      ShellWord(launch.program),
      R"sh( work --join "@$launch/coordinator.json" --patience 600 \
  --tls "$scratch/keys" --token-file "$launch/join.token")sh",
      launch.HasStore() ? "" : " --blobs " + ShellWord(launch.output + "/.orbweave/blobs"),
      launch.scratch.empty() ? "" : " --scratch " + ShellWordWithNames(launch.scratch),
      launch.scratch_size.empty() ? "" : " --scratch-size " + ShellWord(launch.scratch_size),
      R"sh( \
  --slots "${SLURM_CPUS_PER_TASK:-1}" ${until:+--until "$until"} --grace 50 \
  ${ORBWEAVE_IDLE_EXIT:+--idle-exit "$ORBWEAVE_IDLE_EXIT"} \
  ${memory:+--memory "${memory}MiB"} &
child=$!
)sh",
      WaitOrRequeue(),
      R"sh(case $code in 2 | 126 | 127) echo "$me $(hostname) $code" >>"$launch/refused" ;; esac
exit $code
)sh");
}

}  // namespace orbweave
