"""Notebooks as pages of the site: Markdown, and the pictures that cells show as files beside it."""
import base64
import json

PICTURES = {"image/svg+xml": "svg", "image/png": "png"}


def fenced(language, text):
    return f"```{language}\n{text.rstrip()}\n```\n"


def shown(output, save):
    """What a cell printed, or a picture, of which `save` returns the name."""
    data = output.get("data", {})
    for kind, ending in PICTURES.items():
        if kind in data:
            picture = "".join(data[kind])
            name = save(ending, base64.b64decode(picture) if ending == "png" else picture.encode())
            return f'<img class="drawn" src="{name}" alt="what the cell above draws">\n'
    return fenced("none", "".join(output.get("text") or data.get("text/plain", "")))


def as_markdown(path, folder):
    """The text of the page of a notebook. The notebook itself, to be downloaded, and its pictures go to `folder`."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / path.name).write_bytes(path.read_bytes())
    parts = []

    def save(ending, content):
        name = f"{path.stem}-{len(parts)}.{ending}"
        (folder / name).write_bytes(content)
        return name

    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            parts.append(source + "\n")
            continue
        parts.append(fenced("python", source))
        for output in cell["outputs"]:
            parts.append(shown(output, save))
    parts.insert(1, f'This page is a notebook of Jupyter: <a href="{path.name}" download>{path.name}</a>\n')
    return "\n".join(parts)
