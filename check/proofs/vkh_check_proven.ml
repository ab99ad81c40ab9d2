(* Checks a certificate of a Hausdorff distance by the program that Coq extracted from Checker.v.
   Main.v says what its answer means.

   usage: vkh_check_proven CERTIFICATE CORNERS_A CORNERS_B
   Corners: 9 little-endian doubles a face, as vkh_check writes them (--corners). Exit codes: 0 proven,
   1 refused, 2 usage, 4 broken, 6 the answer cannot be written. *)

exception Refused of string
exception Unreadable of string

let contents name =
  let channel = open_in_bin name in
  Fun.protect ~finally:(fun () -> close_in channel)
    (fun () -> really_input_string channel (in_channel_length channel))

let corners (file : Certificate_file.t) which name =
  let data = contents name in
  let expect holds what = if not holds then raise (Refused (name ^ what)) in
  expect (String.length data = 72 * file.faces.(which)) ": has another number of faces";
  expect (Sha256.of_string data = file.hashes.(which)) ": has other corners (SHA-256)";
  if not (Corners_file.all_finite data) then
    raise (Unreadable (name ^ ": has a coordinate that is not finite"));
  data

let check certificate a b =
  let file = Certificate_file.read (contents certificate) in
  let a = corners file 0 a in
  let b = corners file 1 b in
  let power, a, b = Corners_file.read a b file.placement in
  if not (Proven.check_given power file.certificate a b) then
    raise (Refused "the certificate does not prove its claim");
  let say name (lower, upper) = Printf.printf "proven: %h <= %s <= %h\n" lower name upper in
  List.iteri (fun i bounds -> say (if i = 0 then "h(A,B)" else "h(B,A)") bounds) file.bounds;
  Printf.printf "  for all meshes whose corners are within %h of A's and %h of B's\n"
    file.delta.(0) file.delta.(1)

let complain text code =
  prerr_endline ("vkh_check_proven: " ^ text);
  if code = 6 then close_out_noerr stdout;
  exit code

let () =
  match Sys.argv with
  | [| _; certificate; a; b |] -> (
    (try check certificate a b with
    | Refused what -> complain ("refused: " ^ what) 1
    | Certificate_file.Broken what -> complain (certificate ^ ": " ^ what) 4
    | Unreadable what | Sys_error what -> complain what 4
    | error -> complain (Printexc.to_string error) 4);
    try flush stdout with Sys_error what -> complain ("cannot write the answer: " ^ what) 6)
  | _ -> complain "usage: vkh_check_proven CERTIFICATE CORNERS_A CORNERS_B" 2
