// The colours of a bar, which the file brings: the same as in the picture (host/show/palette.h).
const OUTSIDE = 6, WITHIN = 16;

function coloursOf(hex) {
  const colours = [];
  for (let i = 0; i < hex.length; i += 6) colours.push([0, 2, 4].map((j) => parseInt(hex.slice(i + j, i + j + 2), 16)));
  return colours;
}

function between(colours, first, count, share) {
  const at = Math.min(Math.max(share, 0), 1) * (count - 1);
  const i = Math.min(Math.floor(at), count - 2);
  return [0, 1, 2].map((c) => Math.round(colours[first + i][c] + (colours[first + i + 1][c] - colours[first + i][c]) * (at - i)));
}

/// A side's scale, with its colours as arrays: `colours` below, within and above the limits, `outside` below the bar, over it, and without a side.
export function readScale(scale) {
  return { ...scale, colours: coloursOf(scale.colours), outside: coloursOf(scale.outside) };
}

export const shareOf = (scale, distance) => (scale.high > scale.low ? (distance - scale.low) / (scale.high - scale.low) : distance > scale.high ? 2 : 0);

/// [red, green, blue] in 0..255 of a distance.
export function colourOf(scale, distance) {
  let share = shareOf(scale, distance);
  if (share > 1) return scale.outside[1];
  if (share < 0) return scale.outside[0];
  const { from, to, bands, colours } = scale;
  if (bands > 0) share = (Math.min(Math.floor(share * bands), bands - 1) + 0.5) / bands;
  if (share < from) return between(colours, 0, OUTSIDE, share / from);
  if (share > to) return between(colours, OUTSIDE + WITHIN, OUTSIDE, (share - to) / (1 - to));
  return between(colours, OUTSIDE, WITHIN, to > from ? (share - from) / (to - from) : 0);
}
