#!/usr/bin/env python3
"""Writes what the options table says elsewhere: completions, the man page's options, docs/options.md, Python's keywords.

usage: make_pages.py PRINT_OPTIONS [--check]    --check: writes nothing, and exits 1 and names each file that is old
"""

import difflib
import json
import pathlib
import re
import subprocess
import sys
import textwrap

SOURCE = pathlib.Path(__file__).resolve().parents[2]
HELP = [("--help", "show the options that are needed most"), ("--help-all", "show all options")]
FILES = {"file", "input"}
MADE = "Made by tools/options/make_pages.py."


def uses_of(option, command):
    return next((use for use in option["uses"] if command in use["of"]), None)


def options_of(table, command):
    return [option for option in table["options"] if uses_of(option, command)]


def short(text):
    """What comes before the first explanation, as completions show it."""
    text = re.split(r": |; |, such as| \[|\. ", text.replace("{lengths}", "a length"))[0].rstrip(".:")
    return (text[0].lower() + text[1:] if not text[:2].isupper() else text).replace("'", "").replace("[", "(").replace("]", ")")


def choices(option, command):
    use = uses_of(option, command)
    return option["choices"] + use["more"]


# bash


def bash_choices(option):
    """The words; those of some commands alone are printed where the command is one of these."""
    words = " ".join(option["choices"])
    for more in sorted({word for use in option["uses"] for word in use["more"]}):
        commands = " ".join(name for use in option["uses"] if more in use["more"] for name in use["of"])
        words += f' $([[ " {commands} " != *" $command "* ]] || echo {more})'
    return words


def bash(table):
    names = [command["name"] for command in table["commands"]]
    lines = [f"# Completion of vkhausdorff for bash. {MADE}", "_vkhausdorff() {",
             "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]-} options=",
             f'  local commands="{" ".join(names)} help"', "  COMPREPLY=()", '  if [ "$COMP_CWORD" = 1 ]; then',
             '    mapfile -t COMPREPLY < <(compgen -W "$commands --help --help-all --version" -- "$current")', "    return", "  fi", "  case $previous in"]
    free = []
    for option in table["options"]:
        if option["kind"] == "flag" or not option["uses"]:
            continue
        if option["choices"]:
            lines.append(f'    --{option["name"]}) mapfile -t COMPREPLY < <(compgen -W "{bash_choices(option)}" -- "$current"); return ;;')
        elif option["kind"] not in FILES | {"folder"}:
            free.append(f"--{option['name']}")
    lines += [f"    {' | '.join(free)}) return ;;", "  esac", "  case $command in"]
    for name in names:
        words = " ".join([f"--{option['name']}" for option in options_of(table, name)] + [word for word, _ in HELP])
        lines.append(f'    {name}) options="{words}" ;;')
    lines += ['    help) options="$commands" ;;', "  esac", "  if [[ $current == -* || $command == help ]]; then",
              '    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")', "  else",
              '    mapfile -t COMPREPLY < <(compgen -f -- "$current")', "  fi", "}", "complete -o filenames -F _vkhausdorff vkhausdorff"]
    return "\n".join(lines) + "\n"


# zsh


def zsh_value(option, command):
    if option["kind"] == "folder":
        return ":folder:_files -/"
    if option["kind"] in FILES:
        return ":file:_files"
    if option["choices"]:
        return f":{option['name']}:({' '.join(choices(option, command))})"
    return f":{option['shape'].lower()}:"


def zsh_option(option, command):
    text = short(uses_of(option, command)["help"])
    if option["kind"] != "flag":
        return f"'--{option['name']}[{text}]{zsh_value(option, command)}'"
    return f"'--{option['name']}=-[{text}]::file:_files'" if option["shape"] else f"'--{option['name']}[{text}]'"


def zsh(table):
    names = " ".join(command["name"] for command in table["commands"])
    lines = ["#compdef vkhausdorff", f"# Completion of vkhausdorff for zsh. {MADE}", "if (( CURRENT == 2 )); then", f"  _values command {names} help",
             "  return", "fi", "local command=$words[2]", "shift words", "(( CURRENT-- ))", "case $command in"]
    for command in table["commands"]:
        words = [zsh_option(option, command["name"]) for option in options_of(table, command["name"])]
        words += [f"'{word}[{text}]'" for word, text in HELP]
        words += [f"'{'*' if one['several'] else ''}:{one['name']}:_files'" for one in command["positionals"]]
        lines += [f"  {command['name']})", "    _arguments \\", *(f"      {word} \\" for word in words[:-1]), f"      {words[-1]}", "    ;;"]
    return "\n".join([*lines, f"  help) _values command {names} ;;", "esac"]) + "\n"


# The man page


def roff(text):
    return text.replace("\\", "\\e").replace("-", "\\-")


def man_option(option, count):
    name, shape = roff(f"--{option['name']}"), roff(option["shape"])
    head = f".B {name}" if not shape else f".BR {name} {shape}" if shape.startswith("[") else f'.BI {name} " {shape}"'
    texts = []
    for use in option["uses"]:
        of = "" if len(use["of"]) == count else ", ".join(use["of"]) + ": "
        default = f" [{use['otherwise']}]" if use["otherwise"] else ""
        texts.append(of + use["help"].replace("{lengths}", "see LENGTHS") + default + ".")
    body = "\n.br\n".join("\n".join(textwrap.wrap(roff(text), 118, break_on_hyphens=False)) for text in texts)
    return f".TP\n{head}\n" + re.sub(r"^\.(?!br$)", r"\\&.", body, flags=re.M)


def man_options(table):
    lines, heading = [".SH OPTIONS"], None
    for option in table["options"]:
        if not option["uses"]:
            continue
        if option["group"] != heading:
            heading = option["group"]
            lines.append(f".SS {heading}")
        lines.append(man_option(option, len(table["commands"])))
    lines += [".SS Help", ".TP", r".BR \-h , \-\-help", "Show the options of a command that are needed most.", ".TP", r".B \-\-help\-all",
              "Show all of them, in groups; without a command those of each.", ".TP", r".BR \-V , \-\-version", "Print the version."]
    return "\n".join(lines) + "\n"


def man(table):
    path = SOURCE / "docs/man/vkhausdorff.1"
    before, rest = path.read_text(encoding="utf-8").split(".SH OPTIONS\n", 1)
    return before + man_options(table) + ".SH EXIT STATUS\n" + rest.split(".SH EXIT STATUS\n", 1)[1]


# The reference


def cell(text):
    return text.replace("|", "\\|")


def meaning(option):
    """The first sentence of its help, of the command that names it first."""
    text = re.split(r"; |\. | \[|, such as", option["uses"][0]["help"].replace("{lengths}", "a length"))[0].rstrip(".:")
    return text if text[1].isupper() else text[0].lower() + text[1:]


def reference(table):
    lines = ["# Options", "", "Every option: what it does, in short, and where it is: in commands, in the columns of a [batch's list](batch.md#the-list), in Python.",
             "`vkhausdorff COMMAND --help-all` has all of its help, [limits](limits.md#lengths) what a LENGTH is.", "",
             "The last column says whether `batch --resume` does a pair again if the option has changed; [below](#what-is-not-redone) says why not.",
             f"{MADE[:-1]} from `host/answer/options_table.cpp`.", ""]
    groups = dict.fromkeys(option["group"] for option in table["options"])
    kept = {}  # the options of each reason for not doing a pair again
    for group in groups:
        lines += [f"## {group}", "", "| option | commands | column | Python | redone |", "|---|---|---|---|---|"]
        for option in table["options"]:
            if option["group"] != group:
                continue
            name = f"`--{option['name']}{'' if not option['shape'] or option['shape'][0] == '[' else ' '}{cell(option['shape'])}`"
            name = f"{name}<br>{cell(meaning(option))}" if option["uses"] else "–"
            of = ", ".join(dict.fromkeys(command for use in option["uses"] for command in use["of"])) or "–"
            column = f"`{option['name'].replace('-', '_')}`" if option["column"] else "–"
            functions = ", ".join(option["functions"])
            keyword = f"`{option['keyword']}` of {functions}" if functions else "–"
            in_batch = option["column"] or "batch" in of
            redone = "–" if not in_batch else "no" if option["unlike"] else "yes"
            if redone == "no":
                kept.setdefault(option["unlike"], []).append(f"`--{option['name']}`")
            lines.append(f"| {name} | {of} | {column} | {keyword} | {redone} |")
        lines.append("")
    lines += ["## What is not redone", "", "| options | why a pair's result stays |", "|---|---|"]
    return "\n".join(lines + [f"| {', '.join(options)} | {reason} |" for reason, options in kept.items()]) + "\n"


# Python's keywords, of which make_stub.py makes types


def keywords(table):
    functions = {}
    for option in table["options"]:
        for function, default in option["functions"].items():
            row = {"name": option["keyword"], "kind": option["kind"], "default": default,
                   "choices": option["choices"] if option["kind"] in ("choice", "unit") else []}
            functions.setdefault(function, []).append(row)
    lines = [f' "{name}": [\n  ' + ",\n  ".join(json.dumps(row) for row in rows) + "\n ]" for name, rows in functions.items()]
    return "{\n" + ",\n".join(lines) + "\n}\n"


def pages(table):
    return {"tools/completion/vkhausdorff.bash": bash(table), "tools/completion/_vkhausdorff": zsh(table),
            "docs/man/vkhausdorff.1": man(table), "docs/options.md": reference(table), "host/python/keywords.json": keywords(table)}


def main():
    table = json.loads(subprocess.run([sys.argv[1]], capture_output=True, text=True, check=True, timeout=60).stdout)
    is_check, old = "--check" in sys.argv, []
    for name, text in pages(table).items():
        path = SOURCE / name
        known = path.read_text(encoding="utf-8") if path.exists() else ""
        if known == text:
            continue
        old.append(name)
        if is_check:
            sys.stdout.writelines(difflib.unified_diff(known.splitlines(True), text.splitlines(True), name, "made from the table", n=1))
        else:
            path.write_text(text, encoding="utf-8")
    if is_check and old:
        sys.exit(f"{', '.join(old)}: not what the options table says; run tools/options/make_pages.py {sys.argv[1]}")


if __name__ == "__main__":
    main()
