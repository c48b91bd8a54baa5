"""Names that pages must show as what they are: 200 of them. Where one runs, it marks the page as owned."""

_OWN = "document.body.dataset.owned=1"
_SHAPES = (
    "<img src=x onerror={own}>", "<script>{own}</script>", "</script><script>{own}</script>",
    "</title><svg onload={own}>",
    "<!--<script>{own}", "]]><script>{own}</script>", '"><svg/onload={own}>', "' onmouseover='{own}' x='",
    "javascript:{own}", "${{{own}}}", "{{{{script}}}}", "</style><style onload={own}>", "\\u003cscript\\u003e{own}",
    "&lt;script&gt;{own}", "\u202etxt.{own}", "a\nb\r\n{own}", "\u2028{own}\u2029", "\\1 \\g<0> {own}",
    "</textarea><iframe srcdoc='<script>parent.{own}</script>'>", "__proto__{own}",
)  # fmt: skip
_WRAPS = ("{}", " {} ", "{}.jpg", "ä{}", "'{}'", '"{}"', "{}" + "x" * 150, "../../{}", "%00{}", "{}\u200f\u0007")

NAMES = [wrap.replace("{}", shape.format(own=_OWN)) for shape in _SHAPES for wrap in _WRAPS]
