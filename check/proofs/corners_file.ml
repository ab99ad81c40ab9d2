(* Reads corners, 9 doubles a face, and says where a certificate puts them, in the words of the
   theorem: integers times a power of two. *)

open Certificate_file

let number data at = parts_of (Int64.float_of_bits (String.get_int64_le data at))

(* Whether all numbers are finite. The bits of others would be taken for a number, too. *)
let all_finite data =
  let rec from at =
    at >= String.length data
    || (Float.is_finite (Int64.float_of_bits (String.get_int64_le data at)) && from (at + 8)) in
  from 0

(* The least exponent of the numbers that are not 0; max_int where all are. *)
let least count number_of =
  let out = ref max_int in
  for i = 0 to count - 1 do
    let m, e = number_of i in
    if m <> 0 && e < !out then out := e
  done;
  !out

let or_zero e = if e = max_int then 0 else e
let scaled (m, e) power = if m = 0 then Z.zero else Z.shift_left (Z.of_int m) (e - power)

(* Of a matrix of three rows of four. *)
let turns matrix i = parts_of matrix.(4 * (i / 3) + (i mod 3))
let shifts matrix i = parts_of matrix.(4 * i + 3)
let turn_power matrix = or_zero (least 9 (turns matrix))
let own_power data = or_zero (least (String.length data / 8) (fun i -> number data (8 * i)))

(* The greatest power of two of which all placed coordinates times `under` are multiples, or a
   smaller one. *)
let power_of data placement =
  match placement.matrix with
  | None -> own_power data
  | Some matrix -> min (own_power data + turn_power matrix) (least 3 (shifts matrix))

let motion matrix power =
  let row i =
    let entry j = scaled (turns matrix (3 * i + j)) (turn_power matrix) in
    { Proven.ix = entry 0; iy = entry 1; iz = entry 2 } in
  let shift i =
    let m, e = shifts matrix i in
    { Proven.mantissa = Z.of_int m; exponent = Z.of_int (if m = 0 then power else e) } in
  { Proven.turn_power = Z.of_int (turn_power matrix); row_x = row 0; row_y = row 1; row_z = row 2;
    shift_x = shift 0; shift_y = shift 1; shift_z = shift 2 }

let given data placement power =
  let own = own_power data in
  let coordinate at = scaled (number data at) own in
  let point at =
    { Proven.ix = coordinate at; iy = coordinate (at + 8); iz = coordinate (at + 16) } in
  let triangle f =
    { Proven.i0 = point (72 * f); i1 = point (72 * f + 24); i2 = point (72 * f + 48) } in
  { Proven.own_power = Z.of_int own;
    given_faces = List.init (String.length data / 72) triangle;
    lies = { Proven.over = Z.of_float placement.over; under = Z.of_float placement.under;
             moved_by = Option.map (fun matrix -> motion matrix power) placement.matrix } }

(* A power of two whose multiples all coordinates are, and both meshes. *)
let read a b placement =
  let power = min (power_of a placement.(0)) (power_of b placement.(1)) in
  (Z.of_int power, given a placement.(0) power, given b placement.(1) power)
