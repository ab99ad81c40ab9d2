// The colour map that the file brings: the same colours as in the picture.
export function readPalette(hex) {
  const colours = [];
  for (let i = 0; i < hex.length; i += 6) {
    colours.push([0, 2, 4].map((j) => parseInt(hex.slice(i + j, i + j + 2), 16)));
  }
  return colours;
}

/// [red, green, blue] in 0..255, of a number in 0..1.
export function colourAt(palette, t) {
  return palette[Math.round(Math.min(Math.max(t, 0), 1) * (palette.length - 1))];
}
