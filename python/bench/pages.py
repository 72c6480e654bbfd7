"""Tables of pages, which benchmarks write."""


def replace(path, name, lines):
    """Puts lines between the marks of a name, `<!-- name:begin -->` and `<!-- name:end -->`, of a page."""
    begin, end = f"<!-- {name}:begin -->\n", f"<!-- {name}:end -->"
    before, rest = path.read_text().split(begin)
    text = "\n".join(lines).rstrip("\n")
    path.write_text(f"{before}{begin}\n{text}\n\n{end}{rest.split(end)[1]}")
