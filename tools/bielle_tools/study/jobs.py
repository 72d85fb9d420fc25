"""A study for schedulers: an array job of Slurm with a gathering step, and a list of jobs for GNU parallel or xargs.

    FOLDER/plan.json        what the study is
    FOLDER/tasks            numbers of the runs to make, one per line
    FOLDER/array.sbatch     task k makes the runs of its share of the lines
    FOLDER/gather.sbatch    gathers what is there
    FOLDER/submit.sh        submits both, the second after the first
    FOLDER/jobs.txt         one command per line
"""

import os
import shlex

from ..messages import InputError, counted
from .folder import check_folder_of_jobs
from .outputs import check_outputs
from .study import pending, prepare

TASKS = "tasks"


def schedule(plan, folder, study, *, share=1, options=(), fresh=False):
    """Writes the files. study: path of the command; share: runs of one task of the array; options: of sbatch, for the array.
    @returns lines that say what to do"""
    folder = os.path.abspath(folder)
    check_outputs(plan)
    check_folder_of_jobs(folder)
    for what, path in (("the folder of the jobs", folder), ("the command of the study", os.path.abspath(study))):
        if not path.isprintable():
            raise InputError(f"{what}, {path!r}, holds a line break or the like, which the files of a scheduler cannot: choose another name")
    for option in options:
        if not option.startswith("-") or not option.isprintable():
            raise InputError(f"--sbatch {option!r}: an option of sbatch is expected, --sbatch=--time=1:00:00")
    prepare(plan, folder, fresh)
    todo = pending(plan, folder)
    with open(os.path.join(folder, TASKS), "w", encoding="utf-8") as file:
        file.writelines(f"{index + 1}\n" for index in todo)
    name = "".join(letter if letter.isprintable() else "_" for letter in os.path.splitext(os.path.basename(plan.output))[0])
    logs = folder.replace("%", "%%")  # Slurm replaces patterns with %
    command = f"{shlex.quote(os.path.abspath(study))}"
    tasks = -(-len(todo) // share)
    array = ["#!/bin/sh", f"#SBATCH --job-name={shlex.quote(name)}", f"#SBATCH --array=1-{max(tasks, 1)}", "#SBATCH --cpus-per-task=1",
             f"#SBATCH --output={shlex.quote(logs + '/%a.log')}", *(f"#SBATCH {option}" for option in options),
             f"# Task k makes {counted(share, 'run')} of {len(todo)}. Finished ones are not made again.",
             f'exec {command} --run {shlex.quote(folder)} "$SLURM_ARRAY_TASK_ID"' + (f" --share {share}" if share > 1 else "")]
    gather = ["#!/bin/sh", f"#SBATCH --job-name={shlex.quote(name + '-gather')}", "#SBATCH --ntasks=1",
              f"#SBATCH --output={shlex.quote(logs + '/gather.log')}", f"exec {command} --collect {shlex.quote(folder)}"]
    submit = ["#!/bin/sh", "# Submits the runs, and what gathers them when all have ended, however they did.", "set -e",
              f"cd {shlex.quote(folder)}", 'job=$(sbatch --parsable "$@" array.sbatch)', 'sbatch --dependency="afterany:${job%%;*}" gather.sbatch']
    jobs = [f"{command} --run {shlex.quote(folder)} {task + 1}" + (f" --share {share}" if share > 1 else "") for task in range(tasks)]
    for file, lines in (("array.sbatch", array), ("gather.sbatch", gather), ("submit.sh", submit), ("jobs.txt", jobs)):
        path = os.path.join(folder, file)
        with open(path, "w", encoding="utf-8") as opened:
            opened.writelines(line + "\n" for line in lines)
        os.chmod(path, 0o644 if file == "jobs.txt" else 0o755)
    if not todo:
        return [f"all {len(plan.rows)} runs are there: {command} --collect {shlex.quote(folder)}"]
    quoted = shlex.quote(folder)
    return [f"{counted(len(todo), 'run')} to make in {counted(tasks, 'job')}, {len(set(plan.identities)) - len(todo)} there from before",
            f"Slurm:        sh {quoted}/submit.sh",
            f"GNU parallel: parallel < {quoted}/jobs.txt; {command} --collect {quoted}",
            f"xargs:        xargs -d '\\n' -P 4 -I{{}} sh -c '{{}}' < {quoted}/jobs.txt; {command} --collect {quoted}"]


def runs_of_task(plan, folder, task, share):
    """Numbers, from 0, of the runs of a task. @raises InputError"""
    path = os.path.join(folder, TASKS)
    try:
        with open(path, encoding="utf-8") as file:
            todo = [int(line) - 1 for line in file if line.strip()]
    except OSError as error:
        raise InputError(f"cannot read '{path}': {error.strerror}") from None
    except ValueError:
        raise InputError(f"'{path}' is no list of runs, or it is damaged") from None
    first = (task - 1) * share
    chosen = todo[first:first + share]
    if not chosen or not all(0 <= index < len(plan.rows) for index in chosen):
        raise InputError(f"'{folder}' has no task {task}: {len(todo)} runs in shares of {share}")
    return chosen
