// Tables: facts of the chosen tree, or of all trees side by side.

const unfolded = Object.create(null);  // tables that the reader opened or closed

function factTables() {
  const tree = TREES[state.tree];
  return state.mode === "all" && TREES.length > 1 ? tree.tables.map(acrossTrees) : tree.tables;
}

function acrossTrees(table, k) {  // the first column of the same table of every tree
  const columns = TREES.map(function (tree) { return tree.name; });
  const rows = table.rows.map(function (row, r) {
    const values = TREES.map(function (tree) {
      const same = (tree.tables[k] || { rows: [] }).rows[r];
      return same && same.name === row.name ? same.values[0] : "-";
    });
    return { name: row.name, meaning: row.meaning, values: values };
  });
  return { title: table.title, columns: columns, folded: table.folded, rows: rows, across: true };
}

function tabulate(facts) {
  const box = made("details"), all = Boolean(facts.across);
  box.open = facts.title in unfolded ? unfolded[facts.title] : !facts.folded;
  box.addEventListener("toggle", function () { unfolded[facts.title] = box.open; });
  made("summary", box, facts.title);
  const table = made("table", box);
  if (facts.columns.length) {
    const head = table.createTHead().insertRow();
    made("th", head, "");
    facts.columns.forEach(function (words, i) { heading(head, words, all && i === state.tree); });
  }
  const body = table.createTBody();
  facts.rows.forEach(function (fact) {
    const row = body.insertRow();
    row.title = fact.meaning;
    made("td", row, fact.name);
    fact.values.forEach(function (value, i) { made("td", row, value).className = all && i === state.tree ? "here" : ""; });
  });
  return box;
}

function heading(row, words, here) {
  const cell = made("th", row, words);
  cell.title = words;
  cell.className = here ? "here" : "";
}

function levelTable() {  // counts and silhouettes of the levels of detail
  const tree = TREES[state.tree], counts = tree.counts || tree.levels.map(function (level) { return level.triangles; });
  const told = tree.levels.some(function (level) { return level.iou !== null; });
  return {
    title: state.mode === "all" ? "Levels of detail, " + tree.name : "Levels of detail", folded: false, columns: told ? ["triangles", "silhouette IoU"] : ["triangles"],
    rows: counts.map(function (triangles, k) {
      const iou = (tree.levels[k] || {}).iou;
      const values = [triangles.toLocaleString("en")].concat(told ? [typeof iou === "number" ? iou.toFixed(3) : "-"] : []);
      return { name: "LOD " + k, meaning: "overlap of its silhouette with that of LOD 0", values: values };
    }),
  };
}
