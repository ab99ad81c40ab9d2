import fnmatch
import pathlib
import shutil


def load(conanfile, path):
    return pathlib.Path(path).read_text()


def copy(conanfile, pattern, src, dst):
    """Copies every file below src whose path matches, like Conan: `*` goes through folders."""
    root = pathlib.Path(src).resolve()
    top = root / pattern.split("/")[0]
    files = [top] if top.is_file() else [path for path in top.rglob("*") if path.is_file()]
    for path in files:
        name = path.relative_to(root)
        if fnmatch.fnmatch(str(name), pattern):
            (pathlib.Path(dst) / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, pathlib.Path(dst) / name)
