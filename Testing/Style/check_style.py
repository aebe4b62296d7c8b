"""Checks one rule over the whole tree, or all.

usage: check_style.py RULE ROOT     exit 1 and one line for each place that breaks the rule
       check_style.py --all ROOT    the same of every rule
       check_style.py --list        the rules
"""

import sys

import doc_rules
import include_rules
import paper_rules
import text_rules
import version_rules
from source_tree import read_tree

RULES = {
    "FileLength": text_rules.file_length,
    "FolderSize": text_rules.folder_size,
    "Formatting": text_rules.formatting,
    "LineLength": text_rules.line_length,
    "FunctionLength": text_rules.function_length,
    "CommentSubjects": text_rules.comment_subjects,
    "MachinePaths": text_rules.machine_paths,
    "Interpreters": text_rules.interpreters,
    "Addresses": text_rules.addresses,
    "Unfinished": text_rules.unfinished,
    "IdleTests": text_rules.idle_tests,
    "QuietLibraries": text_rules.quiet_libraries,
    "Letters": text_rules.letters,
    "Links": text_rules.links,
    "Anchors": doc_rules.anchors,
    "LinkedNames": doc_rules.linked_names,
    "Papers": paper_rules.papers,
    "TableCommands": doc_rules.table_commands,
    "OldTables": doc_rules.old_tables,
    "Includes": include_rules.includes,
    "KernelOrder": include_rules.kernel_order,
    "ModuleEdges": include_rules.module_edges,
    "OneVersion": version_rules.one_version,
}


def main(arguments):
    if arguments == ["--list"]:
        print("\n".join(f"{name}: {rule.__doc__}" for name, rule in RULES.items()))
        return 0
    if len(arguments) != 2 or arguments[0] not in (*RULES, "--all"):
        print(__doc__, file=sys.stderr)
        return 2
    files = read_tree(arguments[1])
    if not any(file.is_cpp for file in files):
        print(f"{arguments[1]} holds no source: is it the project's root?", file=sys.stderr)
        return 2
    broken = False
    for name in RULES if arguments[0] == "--all" else arguments[:1]:
        faults = list(RULES[name](files))
        for path, line, message in faults:
            print(f"{path}:{line}: {message}")
        print(f"{name}: {len(files)} files, {len(faults)} faults")
        broken = broken or bool(faults)
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
