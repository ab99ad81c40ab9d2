// Certified shares of the area, as the survey enclosed them (host/show/page_words.cpp writes them
// by the same rule).

/// [lower, upper]: the share of the area within a tolerance; null if it was not measured. Each point
/// of the curve holds alone: what is within less is within more.
export function shareWithin(side, value, isLimit) {
  if (isLimit && side.atLimit) return side.atLimit;
  if (!side.curve.length) return null;
  let lower = 0, upper = 1;
  for (const [distance, low, high] of side.curve) {
    if (distance <= value) lower = low;
    if (distance >= value) {
      upper = high;
      break;
    }
  }
  return [lower, Math.max(lower, upper)];
}

export const rest = ([lower, upper]) => [1 - upper, 1 - lower];

function percent(share, round, slack) {
  if (share <= 0) return '0';
  if (share >= 1) return '100';
  return Math.min(Math.max(round(1e4 * share + slack) / 100, 0), 100).toFixed(2);
}

/// "98.87 to 98.90 %", rounded outward.
export function shareText([lower, upper]) {
  const low = percent(lower, Math.floor, -1e-9), high = percent(upper, Math.ceil, 1e-9);
  return `${low === high ? low : `${low} to ${high}`} %`;
}
