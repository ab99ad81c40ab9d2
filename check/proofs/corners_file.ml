(* Reads corners, 9 doubles a face, and puts them where a certificate says, exactly: as integers times
   the step of a grid that both meshes have. *)

open Certificate_file

let number data at = parts_of (Int64.float_of_bits (String.get_int64_le data at))

(* The least of some exponents, of numbers that are not 0; max_int where all are. *)
let least count number_of =
  let out = ref max_int in
  for i = 0 to count - 1 do
    let m, e = number_of i in
    if m <> 0 && e < !out then out := e
  done;
  !out

let or_zero e = if e = max_int then 0 else e

(* Of a matrix of three rows of four. *)
let turns matrix i = parts_of matrix.(4 * (i / 3) + (i mod 3))
let shifts matrix i = parts_of matrix.(4 * i + 3)

let turn_exponent matrix = or_zero (least 9 (turns matrix))

(* The exponent of a step of which all coordinates times `under` are multiples. *)
let exponent data placement =
  let own = or_zero (least (String.length data / 8) (fun i -> number data (8 * i))) in
  match placement.matrix with
  | None -> own
  | Some matrix -> min (own + turn_exponent matrix) (least 3 (shifts matrix))

let whole x = Z.of_float x
let scaled (m, e) power = if m = 0 then Z.zero else Z.shift_left (Z.of_int m) (e - power)

(* From a point's three numbers to the integers of its place. *)
let placing placement power times =
  let over = whole placement.over and under = whole placement.under in
  match placement.matrix with
  | None ->
    let factor = Z.mul over times in
    fun p -> Array.map (fun x -> Z.mul factor (scaled x power)) p
  | Some matrix ->
    let turn = turn_exponent matrix in
    let row i = (Array.init 3 (fun j -> scaled (turns matrix (3 * i + j)) turn), scaled (shifts matrix i) power) in
    let rows = Array.init 3 row in
    fun p ->
      let at = Array.map (fun x -> scaled x (power - turn)) p in
      let put (row, shift) =
        let turned = Z.add (Z.mul row.(0) at.(0)) (Z.add (Z.mul row.(1) at.(1)) (Z.mul row.(2) at.(2))) in
        Z.mul times (Z.add (Z.mul over turned) (Z.mul under shift)) in
      Array.map put rows

let triangles data place =
  let point at =
    let p = place (Array.init 3 (fun i -> number data (at + 8 * i))) in
    { Proven.ix = p.(0); iy = p.(1); iz = p.(2) } in
  let triangle f = { Proven.i0 = point (72 * f); i1 = point (72 * f + 24); i2 = point (72 * f + 48) } in
  List.init (String.length data / 72) triangle

(* The grid and both meshes. *)
let read a b placement =
  let power = min (exponent a placement.(0)) (exponent b placement.(1)) in
  let under i = whole placement.(i).under in
  let mesh data i = triangles data (placing placement.(i) power (under (1 - i))) in
  ({ Proven.power = Z.of_int power; scale = Z.mul (under 0) (under 1) }, mesh a 0, mesh b 1)
