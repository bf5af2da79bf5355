#!/usr/bin/env bash
# One picture by a Slurm array: every task renders its share of the samples, a last job merges them and submits
# again what is missing. Run on a login node, from a folder that all nodes see:
#   render.sh [-n SPP] [-k TASKS] [-f FOLDER] [-s "OPTIONS OF sbatch"]... -- [SCENE] [OPTIONS OF triad render]...
# It prints the number of the merging job. FOLDER then holds picture.film, picture.exr, a film and a log of every share.
# TRIAD names the program (default: triad).
set -euo pipefail
: "${TRIAD:=triad}" "${TRIAD_FOLDER:=picture}" "${TRIAD_SPP:=1024}" "${TRIAD_TASKS:=16}" "${TRIAD_ROUND:=0}" "${TRIAD_SBATCH:=}"
most_rounds=5 # in which shares are submitted again

# sbatch gives jobs a copy of the script, so that it is told where it lies.
export TRIAD TRIAD_FOLDER TRIAD_SPP TRIAD_TASKS TRIAD_ROUND TRIAD_SBATCH TRIAD_SCRIPT=${TRIAD_SCRIPT:-$(readlink -f -- "$0")}

# SHARES as Slurm writes them (0-15, or 3,7): an array for them, and a merge when it has ended, however that was.
submit() { # SHARES OPTION...
    local shares=$1 array
    shift
    # shellcheck disable=SC2086  # options of sbatch, one word each
    array=$(TRIAD_ROLE=task sbatch --parsable --array="$shares" --requeue --signal=B:TERM@120 --open-mode=append \
        --output="$TRIAD_FOLDER/share-%a.log" --job-name=triad $TRIAD_SBATCH "$TRIAD_SCRIPT" "$@")
    TRIAD_ROLE=merge sbatch --parsable --dependency="afterany:${array%%;*}" --requeue --open-mode=append \
        --output="$TRIAD_FOLDER/merge.log" --job-name=triad-merge "$TRIAD_SCRIPT" "$@"
}

# One share. What a task that was stopped had done is in its film: whoever runs it next goes on from there.
task() { # OPTION...
    local share=$SLURM_ARRAY_TASK_ID film child code=0 where=()
    film=$TRIAD_FOLDER/share-$share.film
    [[ -e $film.done ]] && exit 0
    [[ -n ${SLURM_JOB_GPUS:-${SLURM_STEP_GPUS:-}} ]] && where=(--device gpu)
    [[ -n ${SLURM_CPUS_PER_TASK:-} ]] && where+=(--threads "$SLURM_CPUS_PER_TASK")
    if [[ -e $film ]]; then
        "$TRIAD" render --resume "$film" --progress lines "${where[@]}" &
    else
        "$TRIAD" render "$@" --spp "$TRIAD_SPP" --samples "share:$share/$TRIAD_TASKS" --film "$film" --progress lines "${where[@]}" &
    fi
    child=$!
    trap 'kill -TERM "$child"' TERM # of the time limit or of a preemption: the film is written, and the exit code is 75
    wait "$child" || code=$?
    while kill -0 "$child" 2>/dev/null; do # a trap ends a wait
        code=0
        wait "$child" || code=$?
    done
    ((code == 0)) && touch "$film.done"
    ((code == 75)) && scontrol requeue "${SLURM_ARRAY_JOB_ID}_$share"
    exit "$code"
}

merge() { # OPTION...
    local missing=() parts=() share
    for ((share = 0; share < TRIAD_TASKS; ++share)); do
        parts+=("$TRIAD_FOLDER/share-$share.film")
        [[ -e $TRIAD_FOLDER/share-$share.film.done ]] || missing+=("$share")
    done
    if ((${#missing[@]})); then
        if ((TRIAD_ROUND == most_rounds)); then
            echo "Shares ${missing[*]} are missing after $most_rounds rounds; see $TRIAD_FOLDER/share-N.log." >&2
            exit 6
        fi
        echo "Shares ${missing[*]} are missing and are submitted again."
        export TRIAD_ROUND=$((TRIAD_ROUND + 1))
        submit "$(IFS=,; echo "${missing[*]}")" "$@"
        return
    fi
    "$TRIAD" merge "${parts[@]}" -o "$TRIAD_FOLDER/picture.film" --expect-spp "$TRIAD_SPP"
    "$TRIAD" resolve "$TRIAD_FOLDER/picture.film" -o "$TRIAD_FOLDER/picture.exr"
}

case ${TRIAD_ROLE:-} in
task) task "$@" ;;
merge) merge "$@" ;;
*)
    while getopts n:k:f:s: option; do
        case $option in
        n) TRIAD_SPP=$OPTARG ;;
        k) TRIAD_TASKS=$OPTARG ;;
        f) TRIAD_FOLDER=$OPTARG ;;
        s) TRIAD_SBATCH+=" $OPTARG" ;;
        *) sed -n '2,7s/^# //p' "$0" >&2; exit 1 ;;
        esac
    done
    shift $((OPTIND - 1))
    mkdir -p "$TRIAD_FOLDER"
    TRIAD_FOLDER=$(readlink -f -- "$TRIAD_FOLDER")
    if compgen -G "$TRIAD_FOLDER/share-*.film" >/dev/null; then
        echo "$TRIAD_FOLDER holds shares already: name another folder with -f, or remove them." >&2
        exit 1
    fi
    submit "0-$((TRIAD_TASKS - 1))" "$@"
    ;;
esac
