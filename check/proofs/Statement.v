(** The words in which the theorem is stated: points, triangles, surfaces and the two halves of an
    interval of h(A,B). Nothing here is computed. *)
From Coq Require Import Reals List.
Open Scope R_scope.

Record point := Point { px : R; py : R; pz : R }.

Record triangle := Triangle { corner0 : point; corner1 : point; corner2 : point }.

(** The Euclidean distance. *)
Definition distance (p q : point) : R :=
  sqrt ((px p - px q) ^ 2 + (py p - py q) ^ 2 + (pz p - pz q) ^ 2).

(** The sum of a triangle's corners, with the weights a, b and c. *)
Definition combination (a b c : R) (t : triangle) : point :=
  let sum f := a * f (corner0 t) + b * f (corner1 t) + c * f (corner2 t) in
  Point (sum px) (sum py) (sum pz).

(** The points of a triangle: all convex combinations of its corners, which may coincide. *)
Definition covers (t : triangle) (p : point) : Prop :=
  exists a b c, 0 <= a /\ 0 <= b /\ 0 <= c /\ a + b + c = 1 /\ p = combination a b c t.

(** The points of a mesh. *)
Definition surface (m : list triangle) (p : point) : Prop := exists t, In t m /\ covers t p.

(** Each corner of t is within delta of the same corner of s. *)
Definition corners_within (delta : R) (s t : triangle) : Prop :=
  distance (corner0 s) (corner0 t) <= delta /\ distance (corner1 s) (corner1 t) <= delta /\
  distance (corner2 s) (corner2 t) <= delta.

(** The same faces in the same order, with corners that are within delta. *)
Definition within (delta : R) : list triangle -> list triangle -> Prop :=
  Forall2 (corners_within delta).

(** The faces of a mesh by the places of their corners in an array. *)
Definition by_index (vertices : nat -> point) (faces : list (nat * nat * nat)) : list triangle :=
  map (fun '(i, j, k) => Triangle (vertices i) (vertices j) (vertices k)) faces.

(** h(A,B) <= u: every point of A has a point of B within u. *)
Definition at_most (a b : list triangle) (u : R) : Prop :=
  forall p, surface a p -> exists q, surface b q /\ distance p q <= u.

(** h(A,B) >= l: a point of A has no point of B nearer than l. An empty B would have none for any l;
    at_most refuses it, and A is not empty here: see holds_not_empty in Main.v. *)
Definition at_least (a b : list triangle) (l : R) : Prop :=
  exists p, surface a p /\ forall q, surface b q -> l <= distance p q.

(** d is the distance of p from B: the infimum of the distances of p from the points of B. *)
Definition is_distance_to_surface (b : list triangle) (p : point) (d : R) : Prop :=
  (forall q, surface b q -> d <= distance p q) /\
  (forall d', (forall q, surface b q -> d' <= distance p q) -> d' <= d).

(** h is h(A,B): the supremum of the distances of the points of A from B. *)
Definition directed_hausdorff (a b : list triangle) (h : R) : Prop :=
  is_lub (fun d => exists p, surface a p /\ is_distance_to_surface b p d) h.
