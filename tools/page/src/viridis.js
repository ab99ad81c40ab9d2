// The colour map viridis (Smith and van der Walt, CC0), by twenty of its colours.
const STOPS = ['440154', '481568', '482677', '453781', '3f4788', '39558c', '32648e', '2d718e', '287d8e', '238a8d', '1f968b',
  '20a386', '29af7f', '3cbc75', '56c667', '74d055', '94d840', 'b8de29', 'dce318', 'fde725']
  .map((hex) => [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16)));

/// [red, green, blue] in 0..255, of a number in 0..1.
export function viridis(t) {
  const at = Math.min(Math.max(t, 0), 1) * (STOPS.length - 1);
  const low = Math.min(Math.floor(at), STOPS.length - 2);
  return STOPS[low].map((c, i) => Math.round(c + (at - low) * (STOPS[low + 1][i] - c)));
}
