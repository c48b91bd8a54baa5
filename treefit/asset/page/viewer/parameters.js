// Parameters: those of all trees, a column a tree, and where each lies in the range that was searched.

const filter = { differences: true, sorted: false, words: "" };

function parameterPanel(panel) {
  const bar = made("div", panel);
  bar.className = "filter";
  const words = made("input", bar);
  words.type = "search";
  words.placeholder = "name";
  words.value = filter.words;
  const count = made("span"), table = made("table");
  const fill = function () { parameterTable(table, count); };
  if (TREES.length > 1) { tickBox(bar, "only differences", "differences", fill); tickBox(bar, "largest first", "sorted", fill); }
  bar.append(count);
  panel.append(table);
  words.addEventListener("input", function () { filter.words = words.value; fill(); });
  fill();
}

function tickBox(bar, words, name, change) {
  const label = made("label", bar), tick = made("input", label);
  tick.type = "checkbox";
  tick.checked = filter[name];
  label.append(words);
  tick.addEventListener("change", function () { filter[name] = tick.checked; change(); });
}

function parameterTable(table, count) {
  const sought = filter.words.trim().toLowerCase();
  const rows = FACTS.parameters.filter(function (row) {
    return (!filter.differences || row.differs || TREES.length < 2) && row.name.toLowerCase().includes(sought);
  });
  if (filter.sorted) { rows.sort(function (a, b) { return b.spread - a.spread; }); }
  table.textContent = "";
  count.textContent = rows.length + " of " + FACTS.parameters.length;
  const head = table.createTHead().insertRow();
  made("th", head, "");
  TREES.forEach(function (tree, i) { heading(head, TREES.length > 3 ? String(i + 1) : tree.name, i === state.tree); });
  made("th", head, "in its range").title = "filled: the chosen tree";
  const body = table.createTBody();
  rows.forEach(function (row) { parameterRow(body.insertRow(), row); });
}

function parameterRow(line, row) {
  line.title = [row.meaning, row.unit && "in " + row.unit].filter(Boolean).join("\n");
  line.className = row.differs ? "apart" : "same";
  made("td", line, row.name);
  row.values.forEach(function (value, i) {
    const cell = made("td", line, value), here = row.places[state.tree], there = row.places[i];
    cell.className = i === state.tree ? "here" : "other";
    const far = typeof here === "number" && typeof there === "number" ? Math.abs(here - there) : value === row.values[state.tree] ? 0 : 1;
    cell.style.setProperty("--far", Math.sqrt(far).toFixed(3));
    if (i !== state.tree && typeof there === "number" && far > 0) { cell.title = (100 * far).toFixed(far < 0.1 ? 1 : 0) + " % of its range from " + TREES[state.tree].name; }
  });
  const range = made("span", made("td", line));
  range.className = "range";
  row.places.forEach(function (place, i) {
    if (typeof place !== "number") { return; }
    const dot = made("i", range);
    dot.style.left = 100 * place + "%";
    dot.title = TREES[i].name + ": " + row.values[i];
    dot.className = i === state.tree ? "here" : "";
  });
}
