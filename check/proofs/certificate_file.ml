(* Reads the bytes of a certificate, docs/certificate-file.md, into the certificate of the theorem.
   Nothing of this is proven. Soundness needs of it that lower, upper, the deltas and where the
   meshes lie are as the file has them, and that the numbers of triangles are 1 or more. *)

exception Broken of string

type placement = { over : float; under : float; matrix : float array option (* rows of four *) }

type t = {
  faces : int array;
  delta : float array;
  hashes : string array; (* of the corners *)
  placement : placement array;
  bounds : (float * float) list; (* of the directions *)
  certificate : Proven.certificate;
}

type reader = { data : string; mutable at : int; mutable stop : int }

let broken r what = raise (Broken (Printf.sprintf "byte %d: %s" r.at what))
let expect r holds what = if not holds then broken r what

let take r count =
  expect r (count <= r.stop - r.at) "ends too early";
  r.at <- r.at + count;
  r.at - count

let byte r = Char.code r.data.[take r 1]
let short r = String.get_uint16_le r.data (take r 2)
let word r = Int32.to_int (String.get_int32_le r.data (take r 4)) land 0xffffffff

(* A number of 64 bits without a sign. *)
let long r =
  let low = word r in
  let high = word r in
  Z.add (Z.of_int low) (Z.shift_left (Z.of_int high) 32)

let signed_real r =
  let x = Int64.float_of_bits (String.get_int64_le r.data (take r 8)) in
  expect r (Float.is_finite x && not (x = 0. && Float.sign_bit x)) "not a number, or -0";
  x

let real r =
  let x = signed_real r in
  expect r (not (Float.sign_bit x)) "a negative number";
  x

(* A double as mantissa 2^exponent; the mantissa is odd, or both are 0. *)
let parts_of x =
  let bits = Int64.bits_of_float x in
  let fraction = Int64.to_int (Int64.logand bits 0xfffffffffffffL)
  and field = Int64.to_int (Int64.shift_right_logical bits 52) land 2047 in
  let mantissa, exponent =
    if field = 0 then (fraction, -1074) else (fraction lor (1 lsl 52), field - 1075) in
  let rec odd m e =
    if m = 0 then (0, 0) else if m land 1 = 0 then odd (m asr 1) (e + 1) else (m, e) in
  let m, e = odd mantissa exponent in
  ((if Float.sign_bit x then -m else m), e)

let dyadic x =
  let m, e = parts_of x in
  { Proven.mantissa = Z.of_int m; exponent = Z.of_int e }

(* A number in groups of seven bits, the lowest first. *)
let count r =
  let rec more i code =
    expect r (i < 5) "a number of more than five bytes";
    let group = byte r in
    expect r (i = 0 || group <> 0) "a number that is longer than it needs to be";
    let code = code lor ((group land 127) lsl (7 * i)) in
    if group >= 128 then more (i + 1) code else code in
  more 0 0

let polygon r =
  ignore (count r);
  let corners = count r in
  expect r (corners >= 4 && corners < 1 lsl 32) "a polygon of other than four corners or more";
  let axis = count r in
  expect r (axis <= 3) "a triangulation of no kind";
  if axis < 3 then begin
    expect r (3 * (corners - 2) <= r.stop - r.at) "a triangulation that is longer than the file";
    for _ = 1 to 3 * (corners - 2) do
      expect r (count r < corners) "a corner that is not there"
    done
  end

let unit_part r =
  let x = real r in
  expect r (x >= 1. && x <= 0x1p53 && Float.is_integer x)
    "a unit that is no quotient of whole numbers";
  x

(* How a mesh was read. Where it lies is kept: the rest is for those who read the mesh's file. *)
let description r =
  expect r (word r <= 1) "neither a surface nor points";
  expect r (word r <= 1) "bodies of no kind";
  let ambiguity = real r in
  let face = long r in
  expect r (ambiguity > 0. || Z.equal face Z.zero) "a face of no ambiguity";
  let over = unit_part r in
  let under = unit_part r in
  let matrices = long r in
  expect r (Z.leq matrices Z.one) "a matrix of no kind";
  let entries () = Array.init 12 (fun _ -> signed_real r) in
  let matrix = if Z.equal matrices Z.one then Some (entries ()) else None in
  let polygons = long r in
  expect r (Z.leq polygons (Z.of_int (r.stop - r.at))) "more polygons than bytes";
  for _ = 1 to Z.to_int polygons do polygon r done;
  { over; under; matrix }

let corner = function 0 -> Proven.Corner0 | 1 -> Proven.Corner1 | _ -> Proven.Corner2

(* A triangle's number, from 1, coded as its difference from the one before. *)
let triangle r before triangles =
  let code = count r in
  let number = !before + (if code land 1 = 0 then code lsr 1 else -(code lsr 1) - 1) in
  expect r (number >= 0 && number < triangles) "a triangle that is not there";
  before := number;
  number + 1

let rec part r bits before triangles depth =
  let kind = byte r in
  expect r (kind <= 6) "a part of no kind";
  if kind <= 2 then begin
    expect r (depth < 100) "halved more than 100 times";
    let first = part r bits before triangles (depth + 1) in
    let second = part r bits before triangles (depth + 1) in
    Proven.Halved (corner kind, first, second)
  end else begin
    let s = triangle r before triangles in
    if kind = 3 then Proven.Leaf s
    else begin
      let t = triangle r before triangles in
      let fraction () = Z.of_int (if bits = 8 then byte r else short r) in
      let p = fraction () in
      let q = fraction () in
      Proven.Cut (corner (kind - 4), s, t, p, q)
    end
  end

let block r bits faces triangles parts =
  let count = word r in
  let size = word r in
  expect r (count >= 1 && count <= faces) "a block of no, or too many, faces";
  expect r (size <= r.stop - r.at) "a block that is longer than the file";
  let stop = r.stop and before = ref 0 in
  r.stop <- r.at + size;
  for _ = 1 to count do parts := part r bits before triangles 0 :: !parts done;
  expect r (r.at = r.stop) "a block with more bytes than its faces have";
  r.stop <- stop;
  count

let direction r bits faces triangles =
  let lower = real r in
  let upper = real r in
  expect r (lower <= upper) "lower is more than upper";
  let witness = word r in
  let weight_bits = word r in
  expect r (witness < faces && weight_bits <= 62) "a witness that is not there";
  let j = long r in
  let k = long r in
  expect r (Z.leq (Z.add j k) (Z.shift_left Z.one weight_bits)) "a witness that is not on its face";
  expect r (lower > 0. || (witness lor weight_bits = 0 && Z.equal (Z.add j k) Z.zero))
    "a witness where lower is 0";
  let parts = ref [] and left = ref faces in
  while !left > 0 do left := !left - block r bits !left triangles parts done;
  ((lower, upper),
   { Proven.lower = dyadic lower; upper = dyadic upper; witness = Z.of_int witness;
     weight_bits = Z.of_int weight_bits; weight_j = j; weight_k = k; parts = List.rev !parts })

let face_count r =
  let n = long r in
  expect r (Z.leq Z.one n && Z.leq n (Z.of_int (1 lsl 28))) "no face, or too many";
  Z.to_int n

(* Array.init does not say in which order it calls. *)
let two f =
  let a = f () in
  let b = f () in
  [| a; b |]

let read data =
  let r = { data; at = 0; stop = String.length data } in
  let magic = String.sub data (take r 8) 8 in
  expect r (magic = "VHCERT01" || magic = "VHCERT02") "no certificate of version 01 or 02";
  let is_first = magic = "VHCERT01" in
  let directions = word r in
  expect r (directions = 1 || directions = 2) "neither one direction nor two";
  expect r (word r = 0) "not 0";
  let faces = two (fun () -> face_count r) in
  let delta = two (fun () -> real r) in
  ignore (take r 64); (* the files' hashes *)
  let hashes = two (fun () -> String.sub data (take r 32) 32) in
  let as_it_lies () = { over = 1.; under = 1.; matrix = None } in
  let placement = two (fun () -> if is_first then as_it_lies () else description r) in
  let bits = if is_first then 8 else 16 in
  let there_bounds, there = direction r bits faces.(0) faces.(1) in
  let back = if directions = 2 then Some (direction r bits faces.(1) faces.(0)) else None in
  expect r (r.at = r.stop) "more bytes after the last block";
  { faces; delta; hashes; placement;
    bounds = there_bounds :: (match back with None -> [] | Some (bounds, _) -> [ bounds ]);
    certificate =
      { Proven.delta_a = dyadic delta.(0); delta_b = dyadic delta.(1); cut_bits = Z.of_int bits;
        there; back = Option.map snd back } }
