// Overlay: the tree's silhouette and the picture's, compared pixel by pixel where they lie on each other.

const BOTH = [96, 150, 112], PICTURE_ONLY = [226, 122, 44], TREE_ONLY = [58, 108, 214];
const BRANCHES = [121, 85, 61], LEAVES = [76, 153, 60];
const STEP = 100;  // grey of a mask by its class: 0, 100, 200
const images = new Map();

function image(address) {  // of a mask; null until it is there
  if (!address) { return null; }
  if (!images.has(address)) {
    const made = new Image();
    images.set(address, made);
    made.onload = draw;
    made.src = address;
  }
  const found = images.get(address);
  return found.complete && found.naturalWidth ? found : null;
}

function sheet(w, h) {
  const canvas = document.createElement("canvas");
  canvas.width = w; canvas.height = h;
  const pen = canvas.getContext("2d", { willReadFrequently: true });
  pen.imageSmoothingEnabled = false;
  return pen;
}

function pictureClasses(w, h) {  // (w * h) classes of the picture's mask in a cell
  const mask = image(PHOTO.mask), pen = sheet(w, h), at = placing(w, h);
  if (!mask) { return null; }
  const scale = at.tall / ((PHOTO.bottom - PHOTO.top) * mask.naturalHeight);
  pen.drawImage(mask, at.x - PHOTO.base * mask.naturalWidth * scale, at.y - PHOTO.bottom * mask.naturalHeight * scale,
    mask.naturalWidth * scale, mask.naturalHeight * scale);
  return classes(pen, w, h);
}

function treeClasses(tree, w, h) {  // the same of what the search compared
  const mask = image(tree.mask), pen = sheet(w, h), at = placing(w, h);
  if (!mask) { return null; }
  const scale = at.tall / mask.naturalHeight;
  pen.drawImage(mask, at.x - mask.naturalWidth * scale / 2, at.y - at.tall, mask.naturalWidth * scale, at.tall);
  return classes(pen, w, h);
}

function classes(pen, w, h) {
  const pixels = pen.getImageData(0, 0, w, h).data, found = new Uint8Array(w * h);
  for (let k = 0; k < found.length; k++) { found[k] = Math.round(pixels[4 * k] / STEP); }
  return found;
}

function meshSilhouette(tree, cell) {  // of the model as it stands now, from a picture that is not shown
  renderer.setClearColor(0, 0);
  paintTree(tree, cell, { flat: true, bare: true });
  const pen = sheet(cell.w, cell.h), ratio = renderer.getPixelRatio();
  pen.imageSmoothingEnabled = true;
  pen.drawImage(renderer.domElement, cell.x * ratio, cell.y * ratio, cell.w * ratio, cell.h * ratio, 0, 0, cell.w, cell.h);
  const pixels = pen.getImageData(0, 0, cell.w, cell.h).data, found = new Uint8Array(cell.w * cell.h);
  for (let k = 0; k < found.length; k++) { found[k] = pixels[4 * k + 3] > 110 ? 2 : 0; }
  return found;
}

function compare(ours, theirs) {
  const counts = { both: 0, picture: 0, tree: 0 };
  for (let k = 0; k < ours.length; k++) {
    if (ours[k] && theirs[k]) { counts.both++; } else if (ours[k]) { counts.picture++; } else if (theirs[k]) { counts.tree++; }
  }
  return counts;
}

function colourOf(show, ours, theirs, k, w) {  // of pixel k, or null
  if (show === "classes") { return theirs[k] === 1 ? BRANCHES : theirs[k] === 2 ? LEAVES : null; }
  if (show === "difference") {
    return ours[k] && theirs[k] ? BOTH : ours[k] ? PICTURE_ONLY : theirs[k] ? TREE_ONLY : null;
  }
  return border(theirs, k, w) ? TREE_ONLY : border(ours, k, w) ? PICTURE_ONLY : null;
}

function border(mask, k, w) {
  return mask[k] && !(mask[k - 1] && mask[k + 1] && mask[k - w] && mask[k + w] && mask[k - w - 1] && mask[k + w + 1]);
}

function paintOverlay(canvas, tree, cell) {  // colours over the picture; returns what they say
  const show = state.show, live = renderer !== null && tree.nodes && show !== "classes";
  const ours = pictureClasses(cell.w, cell.h), theirs = live ? meshSilhouette(tree, cell) : treeClasses(tree, cell.w, cell.h);
  canvas.width = cell.w; canvas.height = cell.h;
  if (!ours || !theirs) { return null; }
  const pen = canvas.getContext("2d"), out = pen.createImageData(cell.w, cell.h);
  for (let k = 0; k < ours.length; k++) {
    const colour = colourOf(show, ours, theirs, k, cell.w);
    if (!colour) { continue; }
    for (const at of show === "outline" ? [k, k - 1, k - cell.w] : [k]) {  // lines two pixels wide
      if (at >= 0) { out.data.set(colour, 4 * at); out.data[4 * at + 3] = 255; }
    }
  }
  pen.putImageData(out, 0, 0);
  return compare(ours, theirs);
}
