(* Formulas over the real numbers as data, and the primitive inferences of derivations, each a theorem about them. *)
From Coq Require Import Reals ZArith List Bool Lra Lia Classical.
Import ListNotations.
Open Scope R_scope.

(* --- polynomials: terms in falling lexicographic order ---------------------------------------------------------- *)

Definition var := positive.
Definition env := var -> R.
Definition mono := list (var * nat).
Definition poly := list (Z * mono).

Definition upd (e : env) (v : var) (t : R) : env := fun w => if Pos.eqb w v then t else e w.

Fixpoint evm (e : env) (m : mono) : R := match m with [] => 1 | (v, k) :: m => e v ^ k * evm e m end.
Fixpoint evp (e : env) (p : poly) : R := match p with [] => 0 | (c, m) :: p => IZR c * evm e m + evp e p end.

Fixpoint mcmp (m n : mono) : comparison :=
  match m, n with
  | [], [] => Eq
  | [], _ => Lt
  | _, [] => Gt
  | (v, j) :: m, (w, k) :: n =>
      match Pos.compare v w with
      | Lt => Gt
      | Gt => Lt
      | Eq => match Nat.compare j k with Eq => mcmp m n | c => c end
      end
  end.

Lemma mcmp_eq : forall m n, mcmp m n = Eq -> m = n.
Proof.
  induction m as [|[v j] m IH]; destruct n as [|[w k] n]; simpl; try discriminate; auto.
  destruct (Pos.compare_spec v w); try discriminate.
  destruct (Nat.compare_spec j k); try discriminate. intros h. subst. f_equal. auto.
Qed.

Definition cons_term (c : Z) (m : mono) (p : poly) : poly := if Z.eqb c 0 then p else (c, m) :: p.

Lemma cons_term_ok : forall e c m p, evp e (cons_term c m p) = IZR c * evm e m + evp e p.
Proof. intros. unfold cons_term. destruct (Z.eqb_spec c 0); simpl; subst; lra. Qed.

Fixpoint padd (p : poly) : poly -> poly :=
  match p with
  | [] => fun q => q
  | (c, m) :: p' =>
      fix go (q : poly) : poly :=
        match q with
        | [] => p
        | (d, n) :: q' =>
            match mcmp m n with
            | Eq => cons_term (c + d) m (padd p' q')
            | Gt => (c, m) :: padd p' q
            | Lt => (d, n) :: go q'
            end
        end
  end.

Lemma padd_ok : forall e p q, evp e (padd p q) = evp e p + evp e q.
Proof.
  intros e. induction p as [|[c m] p IH]; intros q; [simpl; lra|].
  induction q as [|[d n] q IHq]; [simpl; lra|].
  simpl padd. destruct (mcmp m n) eqn:h.
  - apply mcmp_eq in h. subst. rewrite cons_term_ok, IH, plus_IZR. simpl. lra.
  - simpl in *. rewrite IHq. lra.
  - simpl evp at 1. rewrite IH. simpl. lra.
Qed.

Fixpoint mmul (m : mono) : mono -> mono :=
  match m with
  | [] => fun n => n
  | (v, j) :: m' =>
      fix go (n : mono) : mono :=
        match n with
        | [] => m
        | (w, k) :: n' =>
            match Pos.compare v w with
            | Eq => (v, (j + k)%nat) :: mmul m' n'
            | Lt => (v, j) :: mmul m' n
            | Gt => (w, k) :: go n'
            end
        end
  end.

Lemma mmul_ok : forall e m n, evm e (mmul m n) = evm e m * evm e n.
Proof.
  intros e. induction m as [|[v j] m IH]; intros n; [simpl; lra|].
  induction n as [|[w k] n IHn]; [simpl; lra|].
  simpl mmul. destruct (Pos.compare_spec v w).
  - subst. simpl. rewrite IH, pow_add. ring.
  - simpl evm at 1. rewrite IH. simpl. ring.
  - simpl in *. rewrite IHn. ring.
Qed.

Definition scale (c : Z) (m : mono) (p : poly) : poly := map (fun t => (Z.mul c (fst t), mmul m (snd t))) p.

Lemma scale_ok : forall e c m p, evp e (scale c m p) = IZR c * evm e m * evp e p.
Proof.
  induction p as [|[d n] p IH]; simpl; [lra|].
  rewrite IH, mult_IZR, mmul_ok. ring.
Qed.

Fixpoint pmul (p q : poly) : poly :=
  match p with [] => [] | (c, m) :: p => padd (scale c m q) (pmul p q) end.

Lemma pmul_ok : forall e p q, evp e (pmul p q) = evp e p * evp e q.
Proof.
  induction p as [|[c m] p IH]; intros q; simpl; [lra|].
  rewrite padd_ok, scale_ok, IH. ring.
Qed.

Definition pone : poly := [(1%Z, [])].
Definition pvar (v : var) : poly := [(1%Z, [(v, 1%nat)])].
Definition pneg : poly -> poly := scale (-1) [].
Fixpoint ppow (p : poly) (k : nat) : poly := match k with O => pone | S k => pmul p (ppow p k) end.

Lemma pone_ok : forall e, evp e pone = 1.
Proof. intros. simpl. lra. Qed.
Lemma pvar_ok : forall e v, evp e (pvar v) = e v.
Proof. intros. simpl. lra. Qed.
Lemma pneg_ok : forall e p, evp e (pneg p) = - evp e p.
Proof. intros. unfold pneg. rewrite scale_ok. simpl. lra. Qed.
Lemma ppow_ok : forall e p k, evp e (ppow p k) = evp e p ^ k.
Proof. induction k; simpl; [lra|]. rewrite pmul_ok, IHk. reflexivity. Qed.

Definition psort (p : poly) : poly := fold_right (fun t acc => padd (scale (fst t) (fold_right (fun x m => mmul [x] m) [] (snd t)) pone) acc) [] p.

Lemma msort_ok : forall e m, evm e (fold_right (fun x m => mmul [x] m) [] m) = evm e m.
Proof. induction m as [|[v k] m IH]; [reflexivity|]. cbn [fold_right]. rewrite mmul_ok, IH. simpl. ring. Qed.

Lemma psort_ok : forall e p, evp e (psort p) = evp e p.
Proof.
  induction p as [|[c m] p IH]; [reflexivity|].
  unfold psort in *. cbn [fold_right fst snd]. rewrite padd_ok, scale_ok, msort_ok, IH, pone_ok. simpl. ring.
Qed.

(* --- formulas ---------------------------------------------------------------------------------------------------- *)

Inductive rel := EQ | NE | LT | LE | GT | GE.

Inductive form :=
  | Tr | Fa
  | At (p : poly) (r : rel)
  | An (f g : form)
  | Ou (f g : form)
  | No (f : form)
  | Ex (v : var) (f : form)
  | Al (v : var) (f : form).

Definition rholds (r : rel) (x : R) : Prop :=
  match r with EQ => x = 0 | NE => x <> 0 | LT => x < 0 | LE => x <= 0 | GT => x > 0 | GE => x >= 0 end.

Fixpoint holds (e : env) (f : form) : Prop :=
  match f with
  | Tr => True
  | Fa => False
  | At p r => rholds r (evp e p)
  | An f g => holds e f /\ holds e g
  | Ou f g => holds e f \/ holds e g
  | No f => ~ holds e f
  | Ex v f => exists t : R, holds (upd e v t) f
  | Al v f => forall t : R, holds (upd e v t) f
  end.

Definition all (e : env) (fs : list form) : Prop := Forall (holds e) fs.
Definition entails (fs : list form) (g : form) : Prop := forall e, all e fs -> holds e g.
Definition equiv (fs : list form) (f g : form) : Prop := forall e, all e fs -> (holds e f <-> holds e g).

Definition poly_eq : forall p q : poly, {p = q} + {p <> q}.
Proof. repeat decide equality. Defined.
Definition form_eq : forall f g : form, {f = g} + {f <> g}.
Proof. decide equality; try apply poly_eq; decide equality. Defined.
Definition feq (f g : form) : bool := if form_eq f g then true else false.
Definition peq (p q : poly) : bool := if poly_eq p q then true else false.

Lemma feq_ok : forall f g, feq f g = true -> f = g.
Proof. unfold feq. intros f g. destruct (form_eq f g); [auto|discriminate]. Qed.
Lemma peq_ok : forall f g, peq f g = true -> f = g.
Proof. unfold peq. intros f g. destruct (poly_eq f g); [auto|discriminate]. Qed.

(* --- variables that occur ---------------------------------------------------------------------------------------- *)

Definition inm (v : var) (m : mono) : bool := existsb (fun t => Pos.eqb v (fst t)) m.
Definition inp (v : var) (p : poly) : bool := existsb (fun t => inm v (snd t)) p.
Fixpoint free (v : var) (f : form) : bool :=
  match f with
  | Tr | Fa => false
  | At p _ => inp v p
  | An f g | Ou f g => free v f || free v g
  | No f => free v f
  | Ex w f | Al w f => negb (Pos.eqb v w) && free v f
  end.

Lemma evm_agree : forall e e' m, (forall v, inm v m = true -> e v = e' v) -> evm e m = evm e' m.
Proof.
  induction m as [|[v k] m IH]; intros h; simpl; [auto|].
  rewrite IH, (h v); auto; simpl; [rewrite Pos.eqb_refl; auto|].
  intros w hw. apply h. simpl. rewrite hw. apply orb_true_r.
Qed.

Lemma evp_agree : forall e e' p, (forall v, inp v p = true -> e v = e' v) -> evp e p = evp e' p.
Proof.
  induction p as [|[c m] p IH]; intros h; simpl; [auto|].
  rewrite IH, (evm_agree e e' m); auto; intros v hv; apply h; simpl; rewrite hv; auto using orb_true_r.
Qed.

Lemma holds_agree : forall f e e', (forall v, free v f = true -> e v = e' v) -> (holds e f <-> holds e' f).
Proof.
  induction f; intros e e' h; simpl in *; try tauto.
  - rewrite (evp_agree e e' p); tauto.
  - rewrite (IHf1 e e'), (IHf2 e e'); try tauto; intros v hv; apply h; rewrite hv; auto using orb_true_r.
  - rewrite (IHf1 e e'), (IHf2 e e'); try tauto; intros v hv; apply h; rewrite hv; auto using orb_true_r.
  - rewrite (IHf e e'); tauto.
  - assert (k : forall t, holds (upd e v t) f <-> holds (upd e' v t) f).
    { intros t. apply IHf. intros w hw. unfold upd. destruct (Pos.eqb_spec w v); auto.
      apply h. rewrite hw. destruct (Pos.eqb_spec w v); [congruence|auto]. }
    split; intros [t ht]; exists t; apply k; auto.
  - assert (k : forall t, holds (upd e v t) f <-> holds (upd e' v t) f).
    { intros t. apply IHf. intros w hw. unfold upd. destruct (Pos.eqb_spec w v); auto.
      apply h. rewrite hw. destruct (Pos.eqb_spec w v); [congruence|auto]. }
    split; intros ht t; apply k; auto.
Qed.

Lemma holds_upd : forall f e v t, free v f = false -> (holds (upd e v t) f <-> holds e f).
Proof.
  intros. apply holds_agree. intros w hw. unfold upd. destruct (Pos.eqb_spec w v); congruence.
Qed.

Lemma evp_upd : forall p e v t, inp v p = false -> evp (upd e v t) p = evp e p.
Proof.
  intros. apply evp_agree. intros w hw. unfold upd. destruct (Pos.eqb_spec w v); congruence.
Qed.

(* --- negations ----------------------------------------------------------------------------------------------------- *)

Definition rneg (r : rel) : rel := match r with EQ => NE | NE => EQ | LT => GE | LE => GT | GT => LE | GE => LT end.
Definition rflip (r : rel) : rel := match r with LT => GT | LE => GE | GT => LT | GE => LE | r => r end.

Fixpoint nnf (b : bool) (f : form) : form :=  (* b: negated *)
  match f with
  | Tr => if b then Fa else Tr
  | Fa => if b then Tr else Fa
  | At p r => At p (if b then rneg r else r)
  | An f g => if b then Ou (nnf b f) (nnf b g) else An (nnf b f) (nnf b g)
  | Ou f g => if b then An (nnf b f) (nnf b g) else Ou (nnf b f) (nnf b g)
  | No f => nnf (negb b) f
  | Ex v f => if b then Al v (nnf b f) else Ex v (nnf b f)
  | Al v f => if b then Ex v (nnf b f) else Al v (nnf b f)
  end.

Lemma rneg_ok : forall r x, rholds (rneg r) x <-> ~ rholds r x.
Proof. destruct r; simpl; intros; split; intros; try lra; destruct (Req_dec x 0); tauto || lra. Qed.
Lemma rflip_ok : forall r x, rholds (rflip r) (- x) <-> rholds r x.
Proof. destruct r; simpl; intros; split; intros; try lra; intro; apply H; lra. Qed.

Lemma nnf_ok : forall f e b, holds e (nnf b f) <-> if b then ~ holds e f else holds e f.
Proof.
  induction f; intros e b; simpl; try (destruct b; simpl; tauto).
  - destruct b; simpl; [apply rneg_ok|tauto].
  - specialize (IHf1 e b). specialize (IHf2 e b). destruct b; simpl in *; tauto.
  - specialize (IHf1 e b). specialize (IHf2 e b). destruct b; simpl in *; tauto.
  - specialize (IHf e (negb b)). destruct b; simpl in *; tauto.
  - destruct b; simpl.
    + split.
      * intros h [t ht]. specialize (h t). apply (IHf (upd e v t) true) in h. auto.
      * intros h t. apply (IHf (upd e v t) true). intro k. apply h. exists t. auto.
    + split; intros [t ht]; exists t; apply (IHf (upd e v t) false); auto.
  - destruct b; simpl.
    + split.
      * intros [t ht] h. apply (IHf (upd e v t) true) in ht. auto.
      * intros h. apply not_all_ex_not in h. destruct h as [t ht]. exists t. apply (IHf (upd e v t) true). auto.
    + split; intros ht t; apply (IHf (upd e v t) false); auto.
Qed.

Lemma negated_ok : forall f e, holds e (nnf true f) <-> ~ holds e f.
Proof. intros. apply (nnf_ok f e true). Qed.

(* --- normal forms -------------------------------------------------------------------------------------------------- *)

Definition zholds (r : rel) (c : Z) : bool :=
  match r with
  | EQ => Z.eqb c 0 | NE => negb (Z.eqb c 0) | LT => Z.ltb c 0 | LE => Z.leb c 0 | GT => Z.ltb 0 c | GE => Z.leb 0 c
  end.

Lemma zholds_ok : forall r c, if zholds r c then rholds r (IZR c) else ~ rholds r (IZR c).
Proof.
  destruct r; simpl; intros c.
  - destruct (Z.eqb_spec c 0); [subst; auto|]. intro h. apply eq_IZR in h. lia.
  - destruct (Z.eqb_spec c 0); simpl; [subst; lra|]. intro h. apply eq_IZR in h. lia.
  - destruct (Z.ltb_spec c 0); [apply IZR_lt; auto|]. apply IZR_le in H. lra.
  - destruct (Z.leb_spec c 0); [apply IZR_le; auto|]. apply IZR_lt in H. lra.
  - destruct (Z.ltb_spec 0 c); [apply IZR_lt in H; lra|]. apply IZR_le in H. lra.
  - destruct (Z.leb_spec 0 c); [apply IZR_le in H; lra|]. apply IZR_lt in H. lra.
Qed.

Definition content (p : poly) : Z := fold_right (fun t g => Z.gcd (fst t) g) 0%Z p.
Definition primitive (p : poly) : Z * poly :=
  let g := content p in
  let q := map (fun t => (Z.div (fst t) g, snd t)) p in
  if Z.ltb 0 g && peq (scale g [] q) p then (g, q) else (1%Z, p).

Lemma primitive_ok : forall e p, IZR (fst (primitive p)) > 0 /\ evp e p = IZR (fst (primitive p)) * evp e (snd (primitive p)).
Proof.
  intros. unfold primitive. set (q := map _ p).
  destruct (Z.ltb_spec 0 (content p)); simpl; [|lra].
  destruct (peq _ p) eqn:h; simpl; [|lra].
  apply peq_ok in h. apply IZR_lt in H. split; [lra|]. rewrite <- h at 1. rewrite scale_ok. simpl. ring.
Qed.

Definition atom (p : poly) (r : rel) : form :=
  match psort p with
  | [] => if zholds r 0 then Tr else Fa
  | [(c, [])] => if zholds r c then Tr else Fa
  | q => match snd (primitive q) with
         | ((Zneg _, _) :: _) as s => At (pneg s) (rflip r)
         | s => At s r
         end
  end.

Lemma rscale : forall r c x, c > 0 -> (rholds r (c * x) <-> rholds r x).
Proof.
  intros r c x h.
  assert (k : forall y, y > 0 -> c * y > 0) by (intros; nra).
  destruct (total_order_T x 0) as [[a|a]|a].
  - assert (c * x < 0) by (specialize (k (- x)); lra). destruct r; simpl; split; intros; lra.
  - subst. rewrite Rmult_0_r. tauto.
  - specialize (k x a). destruct r; simpl; split; intros; lra.
Qed.

Lemma atom_ok : forall e p r, holds e (atom p r) <-> rholds r (evp e p).
Proof.
  intros. rewrite <- (psort_ok e p). unfold atom.
  assert (k : forall q, holds e (match snd (primitive q) with
         | ((Zneg _, _) :: _) as s => At (pneg s) (rflip r)
         | s => At s r
         end) <-> rholds r (evp e q)).
  { intros q. destruct (primitive_ok e q) as [h1 h2]. rewrite h2, rscale by auto.
    destruct (snd (primitive q)) as [|[[|c|c] m] s]; cbn [holds]; try tauto.
    rewrite pneg_ok. apply rflip_ok. }
  assert (z : forall c, holds e (if zholds r c then Tr else Fa) <-> rholds r (IZR c)).
  { intros c. pose proof (zholds_ok r c). destruct (zholds r c); simpl; tauto. }
  destruct (psort p) as [|[c [|x m]] [|t q]]; try apply k.
  - apply z.
  - simpl evp. replace (IZR c * 1 + 0) with (IZR c) by lra. apply z.
Qed.

Fixpoint conjuncts (f : form) : list form := match f with An f g => conjuncts f ++ conjuncts g | Tr => [] | f => [f] end.
Fixpoint disjuncts (f : form) : list form := match f with Ou f g => disjuncts f ++ disjuncts g | Fa => [] | f => [f] end.
Definition mem (f : form) (l : list form) : bool := existsb (feq f) l.
Fixpoint once (seen l : list form) : list form :=
  match l with [] => [] | f :: l => if mem f seen then once seen l else f :: once (f :: seen) l end.
Fixpoint conj (l : list form) : form := match l with [] => Tr | [f] => f | f :: l => An f (conj l) end.
Fixpoint disj (l : list form) : form := match l with [] => Fa | [f] => f | f :: l => Ou f (disj l) end.

Lemma mem_ok : forall f l, mem f l = true -> In f l.
Proof.
  unfold mem. intros f l h. apply existsb_exists in h. destruct h as [g [h1 h2]]. apply feq_ok in h2. subst. auto.
Qed.
Lemma conj_ok : forall e l, holds e (conj l) <-> all e l.
Proof.
  unfold all. induction l as [|f [|g l] IH]; simpl.
  - split; auto.
  - split; [auto|]. intros h. inversion h. auto.
  - split; intros h.
    + constructor; [tauto|]. apply IH. tauto.
    + inversion h. split; [auto|]. apply IH. auto.
Qed.
Lemma disj_ok : forall e l, holds e (disj l) <-> Exists (holds e) l.
Proof.
  induction l as [|f [|g l] IH]; simpl.
  - split; [tauto|]. intros h. inversion h.
  - split; [auto|]. intros h. inversion h; auto. inversion H0.
  - split; intros h.
    + destruct h; [auto|]. right. apply IH. auto.
    + inversion h; subst; [auto|]. right. apply IH. auto.
Qed.
Lemma conjuncts_ok : forall e f, all e (conjuncts f) <-> holds e f.
Proof.
  unfold all. induction f; simpl; try (split; [intros h; inversion h; auto|auto]; fail).
  rewrite Forall_app, IHf1, IHf2. tauto.
Qed.
Lemma disjuncts_ok : forall e f, Exists (holds e) (disjuncts f) <-> holds e f.
Proof.
  induction f; simpl; try (split; [intros h; inversion h; auto; inversion H0|auto]; fail).
  - split; [intros h; inversion h|tauto].
  - rewrite Exists_app, IHf1, IHf2. tauto.
Qed.
Lemma once_all : forall e l seen, all e (once seen l ++ seen) <-> all e (l ++ seen).
Proof.
  unfold all. induction l as [|f l IH]; intros seen; simpl; [tauto|].
  destruct (mem f seen) eqn:h.
  - rewrite IH. apply mem_ok in h. split; [|intros k; inversion k; auto]. intros k. constructor; auto.
    rewrite Forall_forall in k. apply k. apply in_or_app. auto.
  - specialize (IH (f :: seen)). rewrite !Forall_app in IH. simpl.
    split; intros k; inversion k; subst; constructor; auto; rewrite Forall_app in *;
    assert (Forall (holds e) (f :: seen)) by (constructor; tauto); tauto.
Qed.
Lemma once_ex : forall e l seen, Exists (holds e) (once seen l ++ seen) <-> Exists (holds e) (l ++ seen).
Proof.
  induction l as [|f l IH]; intros seen; simpl; [tauto|].
  destruct (mem f seen) eqn:h.
  - rewrite IH. apply mem_ok in h. split; [auto|]. intros k. inversion k; subst; auto.
    apply Exists_exists. exists f. split; auto. apply in_or_app. auto.
  - specialize (IH (f :: seen)). rewrite !Exists_app, !Exists_cons in *. rewrite ?Exists_cons, ?Exists_app in *. tauto.
Qed.

Fixpoint norm (f : form) : form :=
  match f with
  | Tr => Tr
  | Fa => Fa
  | At p r => atom p r
  | An f g => let l := once [] (conjuncts (norm f) ++ conjuncts (norm g)) in if mem Fa l then Fa else conj l
  | Ou f g => let l := once [] (disjuncts (norm f) ++ disjuncts (norm g)) in if mem Tr l then Tr else disj l
  | No f => match norm f with Tr => Fa | Fa => Tr | g => No g end
  | Ex v f => let g := norm f in if free v g then Ex v g else g
  | Al v f => let g := norm f in if free v g then Al v g else g
  end.

Lemma norm_ok : forall f e, holds e (norm f) <-> holds e f.
Proof.
  induction f; intros e; simpl; try tauto.
  - apply atom_ok.
  - set (l := once _ _).
    assert (k : all e l <-> holds e f1 /\ holds e f2).
    { unfold l. pose proof (once_all e (conjuncts (norm f1) ++ conjuncts (norm f2)) []) as h.
      rewrite !app_nil_r in h. rewrite h. unfold all. rewrite Forall_app.
      fold (all e (conjuncts (norm f1))). fold (all e (conjuncts (norm f2))). rewrite !conjuncts_ok, IHf1, IHf2. tauto. }
    destruct (mem Fa l) eqn:h; [|rewrite conj_ok; auto]. apply mem_ok in h. rewrite <- k. simpl. split; [tauto|].
    unfold all. rewrite Forall_forall. intros a. apply (a Fa h).
  - set (l := once _ _).
    assert (k : Exists (holds e) l <-> holds e f1 \/ holds e f2).
    { unfold l. pose proof (once_ex e (disjuncts (norm f1) ++ disjuncts (norm f2)) []) as h.
      rewrite !app_nil_r in h. rewrite h, Exists_app, !disjuncts_ok, IHf1, IHf2. tauto. }
    destruct (mem Tr l) eqn:h; [|rewrite disj_ok; auto]. apply mem_ok in h. rewrite <- k. simpl. split; [|tauto].
    intros _. apply Exists_exists. exists Tr. simpl. auto.
  - specialize (IHf e). destruct (norm f); simpl in *; tauto.
  - assert (k : holds e (Ex v (norm f)) <-> holds e (Ex v f)).
    { simpl. split; intros [t ht]; exists t; apply IHf; auto. }
    destruct (free v (norm f)) eqn:h; [auto|]. simpl in k. rewrite <- k. split.
    + intros a. exists 0. apply holds_upd; auto.
    + intros [t ht]. apply holds_upd in ht; auto.
  - assert (k : holds e (Al v (norm f)) <-> holds e (Al v f)).
    { simpl. split; intros ht t; apply IHf; auto. }
    destruct (free v (norm f)) eqn:h; [auto|]. simpl in k. rewrite <- k. split.
    + intros a t. apply holds_upd; auto.
    + intros ht. specialize (ht 0). apply holds_upd in ht; auto.
Qed.

(* --- frame: steps one after the other, at a place, under facts --------------------------------------------------- *)

Lemma all_cons : forall e f l, all e (f :: l) <-> holds e f /\ all e l.
Proof. unfold all. intros. split; intros h; [inversion h; auto|constructor; tauto]. Qed.
Lemma all_in : forall e l f, all e l -> In f l -> holds e f.
Proof. unfold all. intros e l f h k. rewrite Forall_forall in h. auto. Qed.
Lemma all_app : forall e l m, all e (l ++ m) <-> all e l /\ all e m.
Proof. unfold all. intros. apply Forall_app. Qed.
Lemma all_incl : forall e l m, forallb (fun f => mem f m) l = true -> all e m -> all e l.
Proof.
  unfold all. intros e l m h k. rewrite Forall_forall. intros f hf. rewrite forallb_forall in h.
  apply h in hf. apply mem_ok in hf. eapply all_in; eauto.
Qed.

Theorem same : forall G f g, feq (norm f) (norm g) = true -> equiv G f g.
Proof. intros G f g h e _. rewrite <- (norm_ok f), <- (norm_ok g). apply feq_ok in h. rewrite h. tauto. Qed.
Theorem trans : forall G f g h, equiv G f g -> equiv G g h -> equiv G f h.
Proof. intros G f g h a b e k. specialize (a e k). specialize (b e k). tauto. Qed.
Theorem converse : forall G f g, equiv G f g -> equiv G g f.
Proof. intros G f g a e k. specialize (a e k). tauto. Qed.
Theorem weaken : forall G D f g, forallb (fun f => mem f G) D = true -> equiv D f g -> equiv G f g.
Proof. intros G D f g h a e k. apply a. eapply all_incl; eauto. Qed.
Theorem both_negated : forall G f g, equiv G (nnf true f) (nnf true g) -> equiv G f g.
Proof. intros G f g a e k. specialize (a e k). rewrite !negated_ok in a. destruct (classic (holds e f)), (classic (holds e g)); tauto. Qed.
Theorem iff_entails : forall G f g, entails (f :: G) g -> entails (g :: G) f -> equiv G f g.
Proof. intros G f g a b e k. split; intros h; [apply a|apply b]; apply all_cons; auto. Qed.
Theorem entails_equiv : forall G f, entails G f -> equiv G f Tr.
Proof. intros G f a e k. simpl. split; auto. Qed.

Inductive side := L | R_ | D_.  (* the first or the second argument, or the only one *)

Fixpoint facts (f : form) (p : list side) (G : list form) : list form :=
  match p, f with
  | L :: p, An f g => facts f p (conjuncts g ++ G)
  | R_ :: p, An f g => facts g p (conjuncts f ++ G)
  | L :: p, Ou f g => facts f p (conjuncts (nnf true g) ++ G)
  | R_ :: p, Ou f g => facts g p (conjuncts (nnf true f) ++ G)
  | D_ :: p, No f => facts f p G
  | D_ :: p, Ex v f | D_ :: p, Al v f => facts f p (filter (fun g => negb (free v g)) G)
  | _, _ => G
  end.

Fixpoint put (f : form) (p : list side) (h : form) : form :=
  match p, f with
  | L :: p, An f g => An (put f p h) g
  | R_ :: p, An f g => An f (put g p h)
  | L :: p, Ou f g => Ou (put f p h) g
  | R_ :: p, Ou f g => Ou f (put g p h)
  | D_ :: p, No f => No (put f p h)
  | D_ :: p, Ex v f => Ex v (put f p h)
  | D_ :: p, Al v f => Al v (put f p h)
  | _, _ => h
  end.

Fixpoint get (f : form) (p : list side) : form :=
  match p, f with
  | L :: p, An f g | L :: p, Ou f g => get f p
  | R_ :: p, An f g | R_ :: p, Ou f g => get g p
  | D_ :: p, No f | D_ :: p, Ex _ f | D_ :: p, Al _ f => get f p
  | _, _ => f
  end.

Lemma filter_all : forall e v t G, all e G -> all (upd e v t) (filter (fun g => negb (free v g)) G).
Proof.
  intros e v t G h. unfold all. rewrite Forall_forall. intros f k. apply filter_In in k. destruct k as [a b].
  apply holds_upd; [destruct (free v f); auto; discriminate|]. eapply all_in; eauto.
Qed.

Lemma at_place : forall p f G h, equiv (facts f p G) (get f p) h -> equiv G f (put f p h).
Proof.
  induction p as [|s p IH]; intros f G h a e k; [simpl in *; destruct f; apply (a e k)|].
  destruct s, f; simpl in *; try (apply (a e k); fail).
  - destruct (classic (holds e f2)); [|tauto].
    assert (b : holds e f1 <-> holds e (put f1 p h)); [|tauto].
    apply (IH f1 _ h a e). apply all_app. rewrite conjuncts_ok. tauto.
  - destruct (classic (holds e f2)); [tauto|].
    assert (b : holds e f1 <-> holds e (put f1 p h)); [|tauto].
    apply (IH f1 _ h a e). apply all_app. rewrite conjuncts_ok, negated_ok. tauto.
  - destruct (classic (holds e f1)); [|tauto].
    assert (b : holds e f2 <-> holds e (put f2 p h)); [|tauto].
    apply (IH f2 _ h a e). apply all_app. rewrite conjuncts_ok. tauto.
  - destruct (classic (holds e f1)); [tauto|].
    assert (b : holds e f2 <-> holds e (put f2 p h)); [|tauto].
    apply (IH f2 _ h a e). apply all_app. rewrite conjuncts_ok, negated_ok. tauto.
  - rewrite (IH f G h a e k). tauto.
  - split; intros [t ht]; exists t; apply (IH f _ h a (upd e v t)); auto using filter_all.
  - split; intros ht t; apply (IH f _ h a (upd e v t)); auto using filter_all.
Qed.

(* One step of a derivation: under D, A <-> B; A stands in F at a place where D holds. *)
Theorem step : forall p f1 f2 G D a b f,
  equiv D a b ->
  feq (norm f1) (norm f) = true -> feq (get f p) a = true ->
  forallb (fun g => mem g (map norm (facts f p G))) (map norm D) = true ->
  feq (norm (put f p b)) (norm f2) = true ->
  equiv G f1 f2.
Proof.
  intros p f1 f2 G D a b f h1 h0 h2 h3 h4. apply feq_ok in h2. subst a.
  apply trans with f; [apply same; auto|]. apply trans with (put f p b); [|apply same; auto].
  apply at_place. intros e k. apply h1.
  assert (n : forall l, all e (map norm l) <-> all e l).
  { induction l; simpl; [unfold all; tauto|]. rewrite !all_cons, norm_ok. tauto. }
  apply n. eapply all_incl; eauto. apply n. auto.
Qed.

(* --- quantifiers: a search for a proof of f from hypotheses, without anything said about what is compared --------- *)

Definition sw (a b v : var) : var := if Pos.eqb v a then b else if Pos.eqb v b then a else v.
Definition swap_poly (a b : var) (p : poly) : poly := map (fun t => (fst t, map (fun x => (sw a b (fst x), snd x)) (snd t))) p.
Fixpoint swap (a b : var) (f : form) : form :=
  match f with
  | Tr => Tr | Fa => Fa
  | At p r => At (swap_poly a b p) r
  | An f g => An (swap a b f) (swap a b g)
  | Ou f g => Ou (swap a b f) (swap a b g)
  | No f => No (swap a b f)
  | Ex v f => Ex (sw a b v) (swap a b f)
  | Al v f => Al (sw a b v) (swap a b f)
  end.

Lemma sw_sw : forall a b v, sw a b (sw a b v) = v.
Proof.
  intros. unfold sw. destruct (Pos.eqb_spec v a).
  - destruct (Pos.eqb_spec b a); [congruence|]. rewrite Pos.eqb_refl. auto.
  - destruct (Pos.eqb_spec v b); [rewrite Pos.eqb_refl; auto|].
    destruct (Pos.eqb_spec v a); [congruence|]. destruct (Pos.eqb_spec v b); congruence.
Qed.

Lemma swap_upd : forall a b e v t w, upd e (sw a b v) t (sw a b w) = upd (fun x => e (sw a b x)) v t w.
Proof.
  intros. unfold upd. destruct (Pos.eqb_spec w v); [subst; rewrite Pos.eqb_refl; auto|].
  destruct (Pos.eqb_spec (sw a b w) (sw a b v)); auto. exfalso. apply n.
  rewrite <- (sw_sw a b w), <- (sw_sw a b v), e0. auto.
Qed.

Lemma swap_evp : forall a b e p, evp e (swap_poly a b p) = evp (fun x => e (sw a b x)) p.
Proof.
  induction p as [|[c m] p IH]; simpl; [auto|]. rewrite IH. f_equal. f_equal.
  induction m as [|[v k] m IHm]; simpl; congruence.
Qed.

Lemma holds_ext : forall f e e', (forall v, e v = e' v) -> (holds e f <-> holds e' f).
Proof. intros. apply holds_agree. auto. Qed.

Lemma swap_ok : forall a b f e, holds e (swap a b f) <-> holds (fun x => e (sw a b x)) f.
Proof.
  induction f; intros e; simpl; try tauto.
  - rewrite swap_evp. tauto.
  - rewrite IHf1, IHf2. tauto.
  - rewrite IHf1, IHf2. tauto.
  - rewrite IHf. tauto.
  - split; intros [t ht]; exists t.
    + rewrite IHf in ht. revert ht. apply holds_ext. intros. first [apply swap_upd | symmetry; apply swap_upd].
    + rewrite IHf. revert ht. apply holds_ext. intros. first [apply swap_upd | symmetry; apply swap_upd].
  - split; intros ht t; specialize (ht t).
    + rewrite IHf in ht. revert ht. apply holds_ext. intros. first [apply swap_upd | symmetry; apply swap_upd].
    + rewrite IHf. revert ht. apply holds_ext. intros. first [apply swap_upd | symmetry; apply swap_upd].
Qed.

(* w for v in f: f itself for w = v, else w must not be free in f *)
Definition rename (v w : var) (f : form) : form := if Pos.eqb v w then f else norm (swap v w f).
Definition renamable (v w : var) (f : form) : bool := Pos.eqb v w || negb (free w f).

Lemma rename_ok : forall v w f e, renamable v w f = true -> (holds e (rename v w f) <-> holds (upd e v (e w)) f).
Proof.
  unfold rename, renamable. intros v w f e h. destruct (Pos.eqb_spec v w).
  - subst. apply holds_agree. intros u _. unfold upd. destruct (Pos.eqb_spec u w); congruence.
  - simpl in h. rewrite norm_ok, swap_ok. apply holds_agree. intros u hu. unfold upd, sw.
    destruct (Pos.eqb_spec u v); auto. destruct (Pos.eqb_spec u w); auto. subst. rewrite hu in h. discriminate.
Qed.

(* The first conjunction, quantifier or (if cases) disjunction among the hypotheses, with the others. *)
Fixpoint pick (want : form -> bool) (H done : list form) : option (form * list form) :=
  match H with
  | [] => None
  | f :: H => if want f then Some (f, rev_append done H) else pick want H (f :: done)
  end.

Lemma pick_ok : forall want H done f r e, pick want H done = Some (f, r) -> (all e H /\ all e done <-> holds e f /\ all e r).
Proof.
  induction H as [|g H IH]; simpl; intros done f r e h; [discriminate|].
  destruct (want g).
  - inversion h. subst. rewrite all_cons, rev_append_rev, all_app.
    assert (x : all e (rev done) <-> all e done); [|tauto].
    unfold all. rewrite !Forall_forall. split; intros k x hx; apply k; rewrite <- in_rev in *; auto.
  - rewrite <- (IH _ _ _ e h), !all_cons. tauto.
Qed.

Definition splits (f : form) : bool := match f with An _ _ | Ex _ _ | Fa | Tr => true | _ => false end.
Definition cases (f : form) : bool := match f with Ou _ _ => true | _ => false end.

Fixpoint top (f : form) : positive :=
  let ofp := fun p : poly => fold_right (fun t m => fold_right (fun x m => Pos.max (fst x) m) m (snd t)) 1%positive p in
  match f with
  | Tr | Fa => 1%positive
  | At p _ => ofp p
  | An f g | Ou f g => Pos.max (top f) (top g)
  | No f => top f
  | Ex v f | Al v f => Pos.max v (top f)
  end.

Definition fresh (v : var) (H : list form) (g : form) : var :=
  if existsb (free v) H then Pos.succ (fold_right (fun f m => Pos.max (top f) m) (top g) H) else v.

Section Search.
Variable rec : bool -> list var -> list form -> form -> bool.
Hypothesis rec_ok : forall s names H g, rec s names H g = true -> entails H g.

Definition generalise (s : bool) (names : list var) (H : list form) (v : var) (a : form) : bool :=
  let w := fresh v H (Al v a) in
  negb (existsb (free w) H) && renamable v w a && rec s (w :: names) H (rename v w a).

Definition unfold_one (s : bool) (names : list var) (f : form) (r : list form) (g : form) : bool :=
  match f with
  | An a b => rec s names (a :: b :: r) g
  | Ex v a =>
      let w := fresh v (g :: r) a in
      negb (existsb (free w) (g :: r)) && renamable v w a && rec s (w :: names) (rename v w a :: r) g
  | _ => rec s names r g
  end.

Definition choose (s : bool) (names : list var) (H : list form) (g : form) : bool :=
  match g with
  | Ou a b => rec s names H a || rec s names H b
  | Ex v a => existsb (fun w => renamable v w a && rec s names H (rename v w a)) (v :: names)
  | _ => false
  end.

Definition specialise (s : bool) (names : list var) (H : list form) (g : form) : bool :=
  existsb (fun h =>
    match h with
    | Al v a => existsb (fun w => renamable v w a && negb (mem (rename v w a) H) && rec s names (rename v w a :: H) g) (v :: names)
    | _ => false
    end) H.

Definition by_cases (s : bool) (names : list var) (f : form) (r : list form) (g : form) : bool :=
  match f with Ou a b => rec s names (a :: r) g && rec s names (b :: r) g | _ => false end.

Definition search (s : bool) (names : list var) (H : list form) (g : form) : bool :=
  if feq g Tr || mem g H || mem Fa H then true else
  match g with
  | An a b => rec s names H a && rec s names H b
  | Al v a => generalise s names H v a
  | _ =>
    match pick splits H [] with
    | Some (f, r) => unfold_one s names f r g
    | None =>
      match (if s then pick cases H [] else None) with
      | Some (f, r) => choose false names H g || by_cases s names f r g
      | None => choose s names H g || specialise s names H g
      end
    end
  end.

Lemma not_free : forall w l f, negb (existsb (free w) l) = true -> In f l -> free w f = false.
Proof.
  intros w l f h k. destruct (free w f) eqn:q; auto.
  assert (x : existsb (free w) l = true) by (apply existsb_exists; eauto). rewrite x in h. discriminate.
Qed.

Lemma all_upd : forall e w t l, negb (existsb (free w) l) = true -> (all (upd e w t) l <-> all e l).
Proof.
  intros e w t l h. unfold all. rewrite !Forall_forall.
  split; intros k f hf; apply (holds_upd f e w t (not_free w l f h hf)); auto.
Qed.

Lemma rename_upd : forall v w t f e, renamable v w f = true -> (holds (upd e w t) (rename v w f) <-> holds (upd e v t) f).
Proof.
  intros v w t f e h. rewrite rename_ok by auto. apply holds_agree. intros u hu. unfold upd. rewrite Pos.eqb_refl.
  destruct (Pos.eqb_spec u v); auto. destruct (Pos.eqb_spec u w); auto. subst u.
  unfold renamable in h. rewrite hu in h. destruct (Pos.eqb_spec v w); [congruence|discriminate].
Qed.

Lemma generalise_ok : forall s names H v a, generalise s names H v a = true -> entails H (Al v a).
Proof.
  unfold generalise. intros s names H v a. cbv zeta. set (w := fresh v H (Al v a)). clearbody w.
  intros h e k t. apply andb_true_iff in h. destruct h as [h h3]. apply andb_true_iff in h. destruct h as [h1 h2].
  apply (rename_upd v w t a e h2). apply (rec_ok _ _ _ _ h3). apply all_upd; auto.
Qed.

Lemma unfold_one_ok : forall s names f r g, unfold_one s names f r g = true -> entails (f :: r) g.
Proof.
  intros s names f r g h e k. apply all_cons in k. destruct k as [k1 k2].
  destruct f; try (apply (rec_ok _ _ _ _ h e k2)).
  - simpl in k1. apply (rec_ok _ _ _ _ h). rewrite !all_cons. tauto.
  - cbn [unfold_one] in h. cbv zeta in h. set (w := fresh v (g :: r) f) in h. clearbody w.
    apply andb_true_iff in h. destruct h as [h h3]. apply andb_true_iff in h. destruct h as [h1 h2].
    destruct k1 as [t ht]. assert (z : holds (upd e w t) g).
    { apply (rec_ok _ _ _ _ h3). apply all_cons. split; [apply rename_upd; auto|].
      apply all_upd; auto. cbn [existsb] in h1. rewrite negb_orb in h1. apply andb_true_iff in h1. tauto. }
    apply holds_upd in z; auto. apply (not_free w (g :: r)); simpl; auto.
Qed.

Lemma choose_ok : forall s names H g, choose s names H g = true -> entails H g.
Proof.
  intros s names H g h e k. destruct g; try discriminate; cbn [choose] in h.
  - apply orb_true_iff in h. destruct h as [h|h]; [left|right]; apply (rec_ok _ _ _ _ h e k).
  - apply existsb_exists in h. destruct h as [w [_ h]]. apply andb_true_iff in h. destruct h as [h1 h2].
    apply rec_ok in h2. specialize (h2 e k). apply rename_ok in h2; auto. simpl. eauto.
Qed.

Lemma specialise_ok : forall s names H g, specialise s names H g = true -> entails H g.
Proof.
  intros s names H g h e k. apply existsb_exists in h. destruct h as [f [hf h]]. destruct f; try discriminate.
  apply existsb_exists in h. destruct h as [w [_ h]]. apply andb_true_iff in h. destruct h as [h h3].
  apply andb_true_iff in h. destruct h as [h1 h2]. apply (rec_ok _ _ _ _ h3). apply all_cons. split; auto.
  apply rename_ok; auto. apply (all_in e H _ k hf).
Qed.

Lemma search_ok : forall s names H g, search s names H g = true -> entails H g.
Proof.
  intros s names H g h e k. unfold search in h.
  destruct (feq g Tr || mem g H || mem Fa H) eqn:q.
  { rewrite !orb_true_iff in q. destruct q as [[q|q]|q].
    - apply feq_ok in q. subst. simpl. auto.
    - apply mem_ok in q. eapply all_in; eauto.
    - apply mem_ok in q. apply (all_in e H Fa k) in q. simpl in q. tauto. }
  assert (x : match pick splits H [] with
    | Some (f, r) => unfold_one s names f r g
    | None =>
      match (if s then pick cases H [] else None) with
      | Some (f, r) => choose false names H g || by_cases s names f r g
      | None => choose s names H g || specialise s names H g
      end
    end = true -> holds e g).
  { clear h q. assert (n0 : all e []) by (unfold all; auto).
    destruct (pick splits H []) as [[f r]|] eqn:pk.
    - intros h. apply (unfold_one_ok _ _ _ _ _ h). apply all_cons.
      pose proof (pick_ok _ _ _ _ _ e pk). tauto.
    - destruct (if s then pick cases H [] else None) as [[f r]|] eqn:pc; intros h; apply orb_true_iff in h; destruct h as [h|h];
      try (eapply choose_ok; eauto; fail); try (eapply specialise_ok; eauto; fail).
      destruct s; [|discriminate]. pose proof (pick_ok _ _ _ _ _ e pc) as pe.
      destruct f; try discriminate. apply andb_true_iff in h. destruct h as [h1 h2].
      assert (y : holds e (Ou f1 f2) /\ all e r) by tauto. destruct y as [[y|y] z].
      + apply (rec_ok _ _ _ _ h1). apply all_cons. auto.
      + apply (rec_ok _ _ _ _ h2). apply all_cons. auto. }
  destruct g; try (apply x; exact h).
  - apply andb_true_iff in h. destruct h as [h1 h2]. split; [apply (rec_ok _ _ _ _ h1 e k)|apply (rec_ok _ _ _ _ h2 e k)].
  - apply (generalise_ok _ _ _ _ _ h e k).
Qed.
End Search.

Fixpoint proves (n : nat) : bool -> list var -> list form -> form -> bool :=
  match n with O => fun _ _ _ _ => false | S n => search (proves n) end.

Lemma proves_ok : forall n s names H g, proves n s names H g = true -> entails H g.
Proof.
  induction n; [discriminate|]. intros s names H g h. exact (search_ok (proves n) IHn s names H g h).
Qed.

Theorem quantifiers : forall G f g,
  proves 200 true [] [norm (nnf false f)] (norm (nnf false g)) = true ->
  proves 200 true [] [norm (nnf false g)] (norm (nnf false f)) = true -> equiv G f g.
Proof.
  intros G f g h1 h2 e _. apply proves_ok in h1. apply proves_ok in h2.
  specialize (h1 e). specialize (h2 e). rewrite !all_cons, !norm_ok in *.
  rewrite (nnf_ok f e false), (nnf_ok g e false) in *. assert (all e []) by (unfold all; auto). tauto.
Qed.

Theorem follows : forall H g, proves 200 true [] (map (fun f => norm (nnf false f)) H) (norm (nnf false g)) = true -> entails H g.
Proof.
  intros H g h e k. apply proves_ok in h. specialize (h e). rewrite norm_ok, (nnf_ok g e false) in h. apply h.
  unfold all in *. rewrite Forall_forall in *. intros f hf. apply in_map_iff in hf. destruct hf as [f' [a b]]. subst f.
  rewrite norm_ok, (nnf_ok f' e false). auto.
Qed.

(* --- signs: a tree of cases on the signs of polynomials, each of which ends in a contradiction -------------------- *)

Definition signs := (bool * bool * bool)%type.  (* may be negative, zero, positive *)
Definition any : signs := (true, true, true).
Definition may (s : signs) (x : R) : Prop :=
  let '(n, z, p) := s in (x < 0 -> n = true) /\ (x = 0 -> z = true) /\ (x > 0 -> p = true).

Definition sprod (a b : signs) : signs :=
  let '(n, z, p) := a in let '(m, y, q) := b in (n && q || p && m, z || y, p && q || n && m).
Definition ssum (a b : signs) : signs :=
  let '(n, z, p) := a in let '(m, y, q) := b in (n || m, z && y || n && q || p && m, p || q).
Definition spow (a : signs) (k : nat) : signs :=
  match k with
  | O => (false, false, true)
  | _ => if Nat.even k then let '(n, z, p) := a in (false, z, n || p) else a
  end.

Ltac sign_cases x := destruct (total_order_T x 0) as [[?|?]|?].
Ltac bools := repeat match goal with
  | h : ?a -> ?b = true, k : ?a |- _ => specialize (h k); try rewrite h in *
  end; repeat rewrite ?orb_true_r, ?andb_true_r; simpl; auto.

Lemma sprod_ok : forall a b x y, may a x -> may b y -> may (sprod a b) (x * y).
Proof.
  intros [[n z] p] [[m w] q] x y [h1 [h2 h3]] [k1 [k2 k3]]. simpl.
  sign_cases x; sign_cases y; repeat split; intros; try (exfalso; nra); bools.
Qed.
Lemma ssum_ok : forall a b x y, may a x -> may b y -> may (ssum a b) (x + y).
Proof.
  intros [[n z] p] [[m w] q] x y [h1 [h2 h3]] [k1 [k2 k3]]. simpl.
  sign_cases x; sign_cases y; repeat split; intros; try (exfalso; lra); bools.
Qed.
Lemma pow_even_or_odd : forall k x, (Nat.even (S k) = true -> (x = 0 -> x ^ S k = 0) /\ (x <> 0 -> x ^ S k > 0)) /\
  (Nat.even (S k) = false -> (x < 0 -> x ^ S k < 0) /\ (x = 0 -> x ^ S k = 0) /\ (x > 0 -> x ^ S k > 0)).
Proof.
  induction k; intros x.
  - simpl. split; [discriminate|]. intros _. repeat split; intros; lra.
  - specialize (IHk x). rewrite Nat.even_succ, <- Nat.negb_even. replace (x ^ S (S k)) with (x * x ^ S k) by reflexivity.
    destruct (Nat.even (S k)); destruct IHk as [a b]; split; intros q; try discriminate; clear q.
    + destruct (a eq_refl) as [a1 a2]. repeat split; intros.
      * assert (x ^ S k > 0) by (apply a2; lra). nra.
      * subst. ring.
      * assert (x ^ S k > 0) by (apply a2; lra). nra.
    + destruct (b eq_refl) as [b1 [b2 b3]]. split; intros.
      * subst. ring.
      * sign_cases x; [specialize (b1 r)|contradiction|specialize (b3 r)]; nra.
Qed.
Lemma spow_ok : forall a k x, may a x -> may (spow a k) (x ^ k).
Proof.
  intros [[n z] p] k x [h1 [h2 h3]]. destruct k as [|k]; [simpl; repeat split; intros; lra || auto|].
  destruct (pow_even_or_odd k x) as [a b]. unfold spow. destruct (Nat.even (S k)).
  - destruct (a eq_refl) as [a1 a2]. clear a b. sign_cases x; repeat split; intros;
    try (exfalso; assert (x ^ S k > 0) by (apply a2; lra); lra); try (exfalso; specialize (a1 e); lra); bools.
  - destruct (b eq_refl) as [b1 [b2 b3]]. clear a b. sign_cases x;
    [specialize (b1 r)|specialize (b2 e)|specialize (b3 r)]; repeat split; intros; try (exfalso; lra); auto.
Qed.

Definition product := list (nat * nat).  (* numbers of polynomials, and exponents *)
Definition identity := list (Z * product).
Definition nthp (ps : list poly) (k : nat) : poly := nth k ps [].

Definition expand_product (ps : list poly) (l : product) : poly := fold_right (fun t q => pmul (ppow (nthp ps (fst t)) (snd t)) q) pone l.
Definition expand (ps : list poly) (i : identity) : poly :=
  fold_right (fun t q => padd (scale (fst t) [] (expand_product ps (snd t))) q) [] i.
Definition is_identity (ps : list poly) (i : identity) : bool := peq (psort (expand ps i)) [].

Definition known := (list (poly * signs) * list (form * bool))%type.
Definition sign_of (d : known) (p : poly) : signs :=
  match find (fun t => peq p (fst t)) (fst d) with Some t => snd t | None => any end.
Definition truth_of (d : known) (f : form) : option bool := option_map snd (find (fun t => feq f (fst t)) (snd d)).

Definition zsign (c : Z) : signs := (Z.ltb c 0, Z.eqb c 0, Z.ltb 0 c).
Definition product_sign (ps : list poly) (d : known) (l : product) : signs :=
  fold_right (fun t s => sprod (spow (sign_of d (nthp ps (fst t))) (snd t)) s) (false, false, true) l.
Definition sum_sign (ps : list poly) (d : known) (i : identity) : signs :=
  fold_right (fun t s => ssum (sprod (zsign (fst t)) (product_sign ps d (snd t))) s) (false, true, false) i.

Definition meets (s : signs) (r : rel) : bool :=
  let '(n, z, p) := s in
  match r with EQ => z | NE => n || p | LT => n | LE => n || z | GT => p | GE => z || p end.

Fixpoint possible (d : known) (f : form) : bool :=
  match f with
  | Fa => false
  | At p r => meets (sign_of d p) r
  | An f g => possible d f && possible d g
  | Ou f g => possible d f || possible d g
  | Tr => true
  | f => match truth_of d f with
         | Some b => b
         | None => match truth_of d (norm (nnf true f)) with Some b => negb b | None => true end
         end
  end.

(* A set of signs as a number: 1 for negative, 2 for zero, 4 for positive. *)
Definition coded (k : nat) : signs := (Nat.testbit k 0, Nat.testbit k 1, Nat.testbit k 2).
Definition inter (a b : signs) : signs := let '(n, z, p) := a in let '(m, y, q) := b in (n && m, z && y, p && q).
Definition other (a : signs) : signs := let '(n, z, p) := a in (negb n, negb z, negb p).
Definition empty (a : signs) : bool := let '(n, z, p) := a in negb (n || z || p).

Inductive tree :=
  | Clash                           (* one of the formulas is false *)
  | By (k : nat)                    (* these signs contradict an identity *)
  | Sp (k : nat) (s : nat) (a b : tree)  (* the sign of a polynomial is in a set, is not *)
  | Sf (f : form) (a b : tree).     (* a quantified formula is true, false *)

Fixpoint closes (ps : list poly) (is : list identity) (fs : list form) (d : known) (t : tree) : bool :=
  match t with
  | Clash => negb (forallb (possible d) fs)
  | By k => let '(_, z, _) := sum_sign ps d (nth k is []) in negb z
  | Sp k s a b =>
      let p := nthp ps k in
      let u := inter (sign_of d p) (coded s) in
      let w := inter (sign_of d p) (other (coded s)) in
      (empty u || closes ps is fs ((p, u) :: fst d, snd d) a) && (empty w || closes ps is fs ((p, w) :: fst d, snd d) b)
  | Sf f a b => closes ps is fs (fst d, (f, true) :: snd d) a && closes ps is fs (fst d, (f, false) :: snd d) b
  end.

Definition right_at (e : env) (d : known) : Prop :=
  Forall (fun t => may (snd t) (evp e (fst t))) (fst d) /\ Forall (fun t => if snd t : bool then holds e (fst t) else ~ holds e (fst t)) (snd d).

Lemma sign_of_ok : forall e d p, right_at e d -> may (sign_of d p) (evp e p).
Proof.
  intros e d p [h _]. unfold sign_of. destruct (find _ (fst d)) as [t|] eqn:q; [|simpl; auto].
  apply find_some in q. destruct q as [q1 q2]. apply peq_ok in q2. subst. rewrite Forall_forall in h. apply (h t q1).
Qed.
Lemma truth_of_ok : forall e d f b, right_at e d -> truth_of d f = Some b -> if b then holds e f else ~ holds e f.
Proof.
  intros e d f b [_ h] q. unfold truth_of in q. destruct (find _ (snd d)) as [t|] eqn:k; [|discriminate].
  inversion q. apply find_some in k. destruct k as [k1 k2]. apply feq_ok in k2. subst. rewrite Forall_forall in h. apply (h t k1).
Qed.
Lemma meets_ok : forall s r x, may s x -> rholds r x -> meets s r = true.
Proof.
  intros [[n z] p] r x [h1 [h2 h3]] h. destruct r; simpl in *; auto.
  - sign_cases x; [bools|contradiction|bools].
  - destruct h; bools.
  - destruct h; bools.
Qed.
Lemma possible_ok : forall e d f, right_at e d -> holds e f -> possible d f = true.
Proof.
  intros e d f h. 
  assert (o : forall g, holds e g -> match truth_of d g with
         | Some b => b
         | None => match truth_of d (norm (nnf true g)) with Some b => negb b | None => true end end = true).
  { intros g k. destruct (truth_of d g) as [[]|] eqn:q; auto.
    - apply (truth_of_ok e _ _ _ h) in q. contradiction.
    - destruct (truth_of d (norm (nnf true g))) as [[]|] eqn:q2; auto.
      apply (truth_of_ok e _ _ _ h) in q2. change (holds e (norm (nnf true g))) in q2. rewrite norm_ok, negated_ok in q2. contradiction. }
  induction f; intros k; try (apply (o _ k)); simpl in *; auto.
  - eapply meets_ok; eauto using sign_of_ok.
  - rewrite IHf1, IHf2; tauto.
  - destruct k as [k|k]; [rewrite IHf1|rewrite IHf2]; auto using orb_true_r.
Qed.
Lemma zsign_ok : forall c, may (zsign c) (IZR c).
Proof.
  intros c. unfold zsign. destruct (Z.ltb_spec c 0), (Z.eqb_spec c 0), (Z.ltb_spec 0 c); simpl; repeat split; intros; auto;
  try (subst; simpl in *; lra); try lia; try (apply eq_IZR in H1; lia); try (apply lt_IZR in H1; lia);
  try (apply Rgt_lt, lt_IZR in H1; lia).
Qed.
Lemma product_sign_ok : forall e ps d l, right_at e d -> may (product_sign ps d l) (evp e (expand_product ps l)).
Proof.
  intros e ps d l h. induction l as [|[k j] l IH]; simpl.
  - repeat split; intros; lra || auto.
  - rewrite pmul_ok, ppow_ok. apply sprod_ok; auto. apply spow_ok. apply sign_of_ok. auto.
Qed.
Lemma sum_sign_ok : forall e ps d i, right_at e d -> may (sum_sign ps d i) (evp e (expand ps i)).
Proof.
  intros e ps d i h. induction i as [|[c l] i IH].
  - simpl. repeat split; intros; lra || auto.
  - unfold sum_sign, expand in *. cbn [fold_right fst snd]. rewrite padd_ok, scale_ok. cbn [evm]. rewrite Rmult_1_r.
    apply ssum_ok; auto. apply sprod_ok; [apply zsign_ok|].
    apply product_sign_ok. auto.
Qed.

Lemma may_inter : forall a b x, may a x -> may (inter a b) x \/ may (inter a (other b)) x.
Proof.
  intros [[n z] p] [[m y] q] x [h1 [h2 h3]]. sign_cases x; [destruct m|destruct y|destruct q]; (left; simpl; repeat split; intros; try (exfalso; lra); bools; fail)
  || (right; simpl; repeat split; intros; try (exfalso; lra); bools).
Qed.
Lemma may_empty : forall a x, may a x -> empty a = false.
Proof.
  intros [[n z] p] x [h1 [h2 h3]]. simpl. sign_cases x; [rewrite h1 by auto|rewrite h2 by auto|rewrite h3 by auto]; destruct n, z; auto.
Qed.

Lemma closes_ok : forall ps is fs, forallb (is_identity ps) is = true -> forall t d e,
  closes ps is fs d t = true -> right_at e d -> all e fs -> False.
Proof.
  intros ps is fs hi. induction t as [|n|n s t1 IHt1 t2 IHt2|f t1 IHt1 t2 IHt2]; intros d e h w g; cbn [closes] in h.
  - apply negb_true_iff in h. assert (x : forallb (possible d) fs = true); [|congruence].
    apply forallb_forall. intros f hf. apply (possible_ok e); auto. eapply all_in; eauto.
  - pose proof (sum_sign_ok e ps d (nth n is []) w) as x. destruct (sum_sign ps d (nth n is [])) as [[s z] p].
    apply negb_true_iff in h. subst z. destruct x as [_ [x _]].
    assert (y : evp e (expand ps (nth n is [])) = 0).
    { destruct (nth_in_or_default n is []) as [y|y]; [|rewrite y; reflexivity].
      rewrite forallb_forall in hi. apply hi in y. apply peq_ok in y. rewrite <- psort_ok, y. reflexivity. }
    specialize (x y). discriminate.
  - pose proof (sign_of_ok e d (nthp ps n) w) as x. apply andb_true_iff in h. destruct h as [h1 h2].
    rewrite !orb_true_iff in h1, h2. destruct w as [m1 m2].
    destruct (may_inter _ (coded s) _ x) as [y|y].
    + destruct h1 as [h1|h1]; [rewrite (may_empty _ _ y) in h1; discriminate|]. apply (IHt1 _ e h1); auto.
      split; auto. constructor; auto.
    + destruct h2 as [h2|h2]; [rewrite (may_empty _ _ y) in h2; discriminate|]. apply (IHt2 _ e h2); auto.
      split; auto. constructor; auto.
  - apply andb_true_iff in h. destruct h as [h1 h2]. destruct w as [m1 m2].
    destruct (classic (holds e f)) as [c|c]; [apply (IHt1 _ e h1)|apply (IHt2 _ e h2)]; auto; split; auto; constructor; auto.
Qed.

Definition refutes (ps : list poly) (is : list identity) (t : tree) (fs : list form) : bool :=
  forallb (is_identity ps) is && closes ps is (map (fun f => norm (nnf false f)) fs) ([], []) t.

Lemma refutes_ok : forall ps is t fs e, refutes ps is t fs = true -> all e fs -> False.
Proof.
  intros ps is t fs e h k. apply andb_true_iff in h. destruct h as [h1 h2].
  apply (closes_ok _ _ _ h1 _ _ e h2); [split; constructor|].
  unfold all in *. rewrite Forall_forall in *. intros f hf. apply in_map_iff in hf. destruct hf as [f' [a b]]. subst f.
  rewrite norm_ok, (nnf_ok f' e false). auto.
Qed.

Theorem signs_entail : forall ps is t G f, refutes ps is t (nnf true f :: G) = true -> entails G f.
Proof.
  intros ps is t G f h e k. apply NNPP. intro n. apply (refutes_ok _ _ _ _ e h). apply all_cons. split; auto. apply negated_ok. auto.
Qed.
Theorem signs_equiv : forall ps is t u G f g,
  refutes ps is t (nnf true g :: f :: G) = true -> refutes ps is u (nnf true f :: g :: G) = true -> equiv G f g.
Proof. intros. apply iff_entails; eapply signs_entail; eauto. Qed.

(* --- terms: num / den for a variable ------------------------------------------------------------------------------- *)

Definition degm (x : var) (m : mono) : nat := fold_right (fun t k => if Pos.eqb x (fst t) then (snd t + k)%nat else k) O m.
Definition remm (x : var) (m : mono) : mono := filter (fun t => negb (Pos.eqb x (fst t))) m.
Definition deg (x : var) (p : poly) : nat := fold_right (fun t k => Nat.max (degm x (snd t)) k) O p.
Definition sub (x : var) (num den : poly) (d : nat) (p : poly) : poly :=
  fold_right (fun t q => padd (scale (fst t) (remm x (snd t)) (pmul (ppow num (degm x (snd t))) (ppow den (d - degm x (snd t))))) q) [] p.

Lemma evm_upd : forall e x t m, evm (upd e x t) m = t ^ degm x m * evm e (remm x m).
Proof.
  induction m as [|[v k] m IH]; simpl; [lra|]. rewrite IH. unfold upd. rewrite Pos.eqb_sym.
  destruct (Pos.eqb x v) eqn:q; simpl; [rewrite pow_add|]; ring.
Qed.

Lemma sub_ok : forall e x num den d p, evp e den <> 0 -> (deg x p <= d)%nat ->
  evp e (sub x num den d p) = evp e den ^ d * evp (upd e x (evp e num / evp e den)) p.
Proof.
  intros e x num den d p h. induction p as [|[c m] p IH]; simpl; intros k; [lra|].
  rewrite padd_ok, scale_ok, pmul_ok, !ppow_ok, IH, evm_upd by lia.
  rewrite Rmult_plus_distr_l. f_equal. 
  assert (k1 : (degm x m <= d)%nat) by lia.
  replace (evp e den ^ d) with (evp e den ^ degm x m * evp e den ^ (d - degm x m)) by (rewrite <- pow_add; f_equal; lia).
  unfold Rdiv. rewrite Rpow_mult_distr, pow_inv. field. apply pow_nonzero. auto.
Qed.

Definition even_up (d : nat) : nat := if Nat.even d then d else S d.
Definition exponent (pos : bool) (r : rel) (d : nat) : nat :=
  if pos then d else match r with EQ | NE => d | _ => even_up d end.

Fixpoint subst (x : var) (num den : poly) (pos : bool) (f : form) : form :=
  match f with
  | Tr => Tr | Fa => Fa
  | At p r => if inp x p then At (sub x num den (exponent pos r (deg x p)) p) r else At p r
  | An f g => An (subst x num den pos f) (subst x num den pos g)
  | Ou f g => Ou (subst x num den pos f) (subst x num den pos g)
  | No f => No (subst x num den pos f)
  | Ex v f => Ex v (subst x num den pos f)
  | Al v f => Al v (subst x num den pos f)
  end.

Fixpoint safe (x : var) (num den : poly) (f : form) : bool :=
  match f with
  | An f g | Ou f g => safe x num den f && safe x num den g
  | No f => safe x num den f
  | Ex v f | Al v f => negb (Pos.eqb v x || inp v num || inp v den) && safe x num den f
  | _ => true
  end.

Lemma upd_comm : forall e v t x s f, v <> x -> (holds (upd (upd e v t) x s) f <-> holds (upd (upd e x s) v t) f).
Proof.
  intros. apply holds_ext. intros w. unfold upd. destruct (Pos.eqb_spec w x), (Pos.eqb_spec w v); congruence.
Qed.

Lemma even_pow : forall d x, Nat.even d = true -> x <> 0 -> x ^ d > 0.
Proof.
  intros [|d] x h k; [simpl; lra|]. destruct (pow_even_or_odd d x) as [a _]. destruct (a h) as [_ b]. auto.
Qed.

Lemma subst_ok : forall f x num den pos e, safe x num den f = true -> evp e den <> 0 -> (pos = true -> evp e den > 0) ->
  (holds e (subst x num den pos f) <-> holds (upd e x (evp e num / evp e den)) f).
Proof.
  induction f; intros x num den pos e s h k; simpl in *; try tauto.
  - destruct (inp x p) eqn:q; simpl; [|rewrite evp_upd by auto; tauto].
    assert (le : (deg x p <= exponent pos r (deg x p))%nat).
    { unfold exponent, even_up. destruct pos; auto. destruct r; auto; destruct (Nat.even _); lia. }
    rewrite sub_ok by auto. set (y := evp (upd _ _ _) _).
    assert (z : forall d, evp e den ^ d <> 0) by (intros; apply pow_nonzero; auto).
    destruct pos; [apply rscale, pow_lt; apply k; auto|].
    assert (ev : Nat.even (even_up (deg x p)) = true).
    { unfold even_up. destruct (Nat.even (deg x p)) eqn:ee; auto. rewrite Nat.even_succ, <- Nat.negb_even, ee. auto. }
    pose proof (even_pow _ _ ev h) as evp0.
    destruct r; unfold exponent; try (apply rscale; auto; fail); simpl; specialize (z (deg x p)).
    + split; intros a; [apply Rmult_integral in a; tauto|rewrite a; ring].
    + split; intros a b; apply a; [rewrite b; ring|apply Rmult_integral in b; tauto].
  - apply andb_true_iff in s. rewrite IHf1, IHf2 by tauto. tauto.
  - apply andb_true_iff in s. rewrite IHf1, IHf2 by tauto. tauto.
  - rewrite IHf by tauto. tauto.
  - apply andb_true_iff in s. destruct s as [s1 s2]. rewrite negb_true_iff, !orb_false_iff in s1. destruct s1 as [[s1 s3] s4].
    apply Pos.eqb_neq in s1. split; intros [t ht]; exists t.
    + rewrite IHf in ht by (rewrite ?evp_upd by auto; auto). rewrite !evp_upd in ht by auto. apply upd_comm in ht; auto.
    + rewrite IHf by (rewrite ?evp_upd by auto; auto). rewrite !evp_upd by auto. apply upd_comm; auto.
  - apply andb_true_iff in s. destruct s as [s1 s2]. rewrite negb_true_iff, !orb_false_iff in s1. destruct s1 as [[s1 s3] s4].
    apply Pos.eqb_neq in s1. split; intros ht t; specialize (ht t).
    + rewrite IHf in ht by (rewrite ?evp_upd by auto; auto). rewrite !evp_upd in ht by auto. apply upd_comm in ht; auto.
    + rewrite IHf by (rewrite ?evp_upd by auto; auto). rewrite !evp_upd by auto. apply upd_comm; auto.
Qed.

Definition regular (den : poly) (pos : bool) : form := At den (if pos then GT else NE).

Lemma regular_ok : forall e den pos, holds e (regular den pos) -> evp e den <> 0 /\ (pos = true -> evp e den > 0).
Proof. intros e den [] h; simpl in h; split; intros; auto; lra || discriminate. Qed.

Theorem witness : forall G x num den pos f,
  entails G (regular den pos) -> entails G (subst x num den pos f) -> safe x num den f = true -> entails G (Ex x f).
Proof.
  intros G x num den pos f h1 h2 s e k. destruct (regular_ok e den pos (h1 e k)). simpl. eexists. eapply subst_ok; eauto.
Qed.

Lemma subst_id : forall f x num den pos, free x f = false -> safe x num den f = true -> subst x num den pos f = f.
Proof.
  induction f; intros x num den pos h s; simpl in *; auto; try (rewrite andb_true_iff in s); try (rewrite orb_false_iff in h).
  - rewrite h. auto.
  - rewrite IHf1, IHf2; tauto.
  - rewrite IHf1, IHf2; tauto.
  - rewrite IHf; tauto.
  - destruct s as [s1 s2]. destruct (Pos.eqb_spec v x); [discriminate|]. rewrite IHf; auto.
    destruct (Pos.eqb_spec x v); [congruence|]. auto.
  - destruct s as [s1 s2]. destruct (Pos.eqb_spec v x); [discriminate|]. rewrite IHf; auto.
    destruct (Pos.eqb_spec x v); [congruence|]. auto.
Qed.

Lemma subst_kept : forall x num den pos f e, safe x num den f = true -> holds e (subst x num den pos f) ->
  all e (filter (fun g => negb (free x g)) (conjuncts f)).
Proof.
  intros x num den pos f e. unfold all.
  assert (base : forall g, safe x num den g = true -> holds e (subst x num den pos g) -> Forall (holds e) (filter (fun g => negb (free x g)) [g])).
  { intros g s h. simpl. destruct (free x g) eqn:q; constructor; auto. rewrite subst_id in h; auto. }
  induction f; intros s h; try (apply base; auto; fail); [constructor|].
  simpl in *. rewrite filter_app, Forall_app. apply andb_true_iff in s. tauto.
Qed.

(* Gauss: an equation den * x = num among the conjuncts. *)
Theorem linear : forall G x num den pos f,
  entails (filter (fun g => negb (free x g)) (conjuncts f) ++ G) (regular den pos) ->
  safe x num den f && negb (inp x num) && negb (inp x den) && forallb (fun g => negb (free x g)) G
  && mem (norm (At (padd (pmul den (pvar x)) (pneg num)) EQ)) (map norm (conjuncts f)) = true ->
  equiv G (Ex x f) (subst x num den pos f).
Proof.
  intros G x num den pos f r h e k. rewrite !andb_true_iff, !negb_true_iff in h. destruct h as [[[[s h1] h2] h3] h4].
  assert (reg : all e (filter (fun g => negb (free x g)) (conjuncts f)) -> evp e den <> 0 /\ (pos = true -> evp e den > 0)).
  { intros a. apply regular_ok. apply r. apply all_app. auto. }
  split.
  - intros [t ht]. pose proof ht as hc. rewrite <- conjuncts_ok in hc.
    assert (kept : all e (filter (fun g => negb (free x g)) (conjuncts f))).
    { unfold all in *. rewrite Forall_forall in *. intros g hg. apply filter_In in hg. destruct hg as [a b].
      apply negb_true_iff in b. apply (holds_upd g e x t b). auto. }
    destruct (reg kept) as [r1 r2]. apply subst_ok; auto.
    apply mem_ok, in_map_iff in h4. destruct h4 as [g [a b]].
    pose proof (all_in _ _ _ hc b) as c. rewrite <- (norm_ok g), a, norm_ok in c. simpl in c.
    rewrite padd_ok, pmul_ok, pneg_ok, pvar_ok, !evp_upd in c by auto. unfold upd at 1 in c. rewrite Pos.eqb_refl in c.
    replace (evp e num / evp e den) with t; auto. apply (Rmult_eq_reg_l (evp e den)); auto. field_simplify; auto. lra.
  - intros h. destruct (reg (subst_kept _ _ _ _ _ _ s h)) as [r1 r2]. apply subst_ok in h; auto. simpl. eauto.
Qed.

(* --- what is stated in the language of Coq ------------------------------------------------------------------------ *)

Definition pw (x : R) (k : nat) : R := match k with 1%nat => x | _ => x ^ k end.
Fixpoint times (acc : R) (e : env) (m : mono) : R := match m with [] => acc | (v, k) :: m => times (acc * pw (e v) k) e m end.
Definition term (e : env) (t : Z * mono) : R :=
  match t with (Zpos xH, (v, k) :: m) => times (pw (e v) k) e m | (c, m) => times (IZR c) e m end.
Fixpoint terms (e : env) (p : poly) : R := match p with [] => 0 | [t] => term e t | t :: p => term e t + terms e p end.
Fixpoint says (e : env) (f : form) : Prop :=
  match f with
  | Tr => True
  | Fa => False
  | At p r => rholds r (terms e p)
  | An f g => says e f /\ says e g
  | Ou f g => says e f \/ says e g
  | No f => ~ says e f
  | Ex v f => exists t : R, says (upd e v t) f
  | Al v f => forall t : R, says (upd e v t) f
  end.
Fixpoint if_all (e : env) (fs : list form) (P : Prop) : Prop := match fs with [] => P | f :: fs => says e f -> if_all e fs P end.
Definition env_of (l : list R) : env := fun v => nth (pred (Pos.to_nat v)) l 0.

Lemma times_ok : forall e m acc, times acc e m = acc * evm e m.
Proof.
  induction m as [|[v k] m IH]; intros acc; simpl; [lra|]. rewrite IH.
  replace (pw (e v) k) with (e v ^ k); [ring|]. destruct k as [|[|k]]; simpl; ring.
Qed.
Lemma terms_ok : forall e p, terms e p = evp e p.
Proof.
  assert (t : forall e c m, term e (c, m) = IZR c * evm e m).
  { intros. unfold term. destruct c as [|[c|c|]|c], m as [|[v k] m]; rewrite times_ok; simpl; try ring.
    replace (pw (e v) k) with (e v ^ k); [ring|]. destruct k as [|[|k]]; simpl; ring. }
  induction p as [|[c m] [|s p] IH]; simpl in *; [auto|rewrite t; ring|]. rewrite t, IH. ring.
Qed.
Lemma says_ok : forall f e, says e f <-> holds e f.
Proof.
  induction f; intros e; simpl; try tauto.
  - rewrite terms_ok. tauto.
  - rewrite IHf1, IHf2. tauto.
  - rewrite IHf1, IHf2. tauto.
  - rewrite IHf. tauto.
  - split; intros [t ht]; exists t; apply IHf; auto.
  - split; intros ht t; apply IHf; auto.
Qed.
Theorem said : forall f g e, equiv [] f g -> (says e f <-> says e g).
Proof. intros. rewrite !says_ok. apply H. unfold all. auto. Qed.
Theorem believed : forall G f g, (forall e, if_all e G (says e f <-> says e g)) -> equiv G f g.
Proof.
  intros G f g h e k. specialize (h e). revert h k. induction G as [|x G IH]; simpl; intros h k.
  - rewrite !says_ok in h. auto.
  - apply all_cons in k. destruct k as [k1 k2]. apply says_ok in k1. auto.
Qed.

(* --- what steps of derivations are made of --------------------------------------------------------------------------- *)

Definition tm (c : Z) (m : mono) : Z * mono := (c, m).
Definition xp (v : var) (k : nat) : var * nat := (v, k).
Arguments tm _%Z _.
Arguments xp _%positive _%nat.
Arguments Ex _%positive _.
Arguments Al _%positive _.
Arguments swap _%positive _%positive _.
Arguments subst _%positive _ _ _ _.
Arguments linear _ _%positive _ _ _ _ _ _ _ _.
Arguments witness _ _%positive _ _ _ _ _ _ _ _ _.
Arguments Sp _%nat _%nat _ _.
Arguments By _%nat.

Fixpoint all_entailed (G D : list form) : Prop := match D with [] => True | f :: D => entails G f /\ all_entailed G D end.
Theorem under : forall G D f g, equiv D f g -> all_entailed G D -> equiv G f g.
Proof.
  intros G D f g h k e a. apply h. clear h. induction D as [|x D IH]; [constructor|]. destruct k as [k1 k2].
  apply all_cons. auto.
Qed.
Theorem via : forall b G f g f' g', equiv G f' g' ->
  feq (norm (nnf b f)) (norm f') = true -> feq (norm (nnf b g)) (norm g') = true -> equiv G f g.
Proof.
  intros b G f g f' g' h k1 k2 e a. specialize (h e a). apply feq_ok in k1. apply feq_ok in k2.
  rewrite <- (norm_ok f'), <- (norm_ok g'), <- k1, <- k2, !norm_ok, (nnf_ok f e b), (nnf_ok g e b) in h.
  destruct b; [|auto]. destruct (classic (holds e f)), (classic (holds e g)); tauto.
Qed.
(* What is refuted whatever the values of its variables are holds for none. *)
Theorem refuted : forall s f, equiv [] s Fa -> proves 200 true [] [norm (nnf false f)] (norm (nnf false s)) = true ->
  entails [] (nnf true f).
Proof.
  intros s f h k e a. apply negated_ok. intro x. apply proves_ok in k. apply (h e a).
  rewrite <- (nnf_ok s e false), <- norm_ok. apply k. apply all_cons. split; auto. rewrite norm_ok, (nnf_ok f e false). auto.
Qed.
Theorem without_exception : forall G f g, entails G (nnf true (An f (nnf true g))) -> entails G (nnf true (An g (nnf true f))) -> equiv G f g.
Proof.
  intros G f g h k e a. specialize (h e a). specialize (k e a). rewrite negated_ok in *. simpl in *. rewrite !negated_ok in *.
  destruct (classic (holds e f)), (classic (holds e g)); tauto.
Qed.
Theorem also : forall G c f g, equiv [] c Tr -> equiv (c :: G) f g -> equiv G f g.
Proof. intros G c f g h k e a. apply k. apply all_cons. split; auto. apply (h e); [constructor|exact I]. Qed.
Theorem and_both : forall G a b c d, equiv G a c -> equiv G b d -> equiv G (An a b) (An c d).
Proof. intros G a b c d h k e x. specialize (h e x). specialize (k e x). simpl. tauto. Qed.
Theorem or_both : forall G a b c d, equiv G a c -> equiv G b d -> equiv G (Ou a b) (Ou c d).
Proof. intros G a b c d h k e x. specialize (h e x). specialize (k e x). simpl. tauto. Qed.
Theorem entails_same : forall G f g, entails G f -> feq (norm f) (norm g) = true -> entails G g.
Proof. intros G f g h k e x. apply feq_ok in k. rewrite <- norm_ok, <- k, norm_ok. auto. Qed.
Theorem entails_by : forall G f g, entails G f -> equiv [] f g -> entails G g.
Proof. intros G f g h k e x. apply (k e); [constructor|auto]. Qed.
Theorem opened : forall v f G g, entails (f :: G) g -> forallb (fun h => negb (free v h)) (g :: G) = true -> entails (Ex v f :: G) g.
Proof.
  intros v f G g h k e x. apply all_cons in x. destruct x as [[t ht] x]. simpl in k. apply andb_true_iff in k. destruct k as [k1 k2].
  apply negb_true_iff in k1. apply (holds_upd g e v t k1). apply h. apply all_cons. split; auto.
  unfold all in *. rewrite Forall_forall in *. rewrite forallb_forall in k2. intros y hy. apply holds_upd; auto.
  apply negb_true_iff. auto.
Qed.
Lemma conj_fold : forall e l, holds e (fold_right An Tr l) <-> all e l.
Proof. induction l; simpl; [split; auto; constructor|]. rewrite all_cons. tauto. Qed.
Definition counterexample (G : list form) (f g : form) : form := fold_right An Tr (G ++ [f; nnf true g]).
Theorem no_exception : forall G f g c d, entails [] (nnf true c) -> entails [] (nnf true d) ->
  feq (norm (nnf false (counterexample G f g))) (norm c) = true ->
  feq (norm (nnf false (counterexample G g f))) (norm d) = true -> equiv G f g.
Proof.
  assert (x : forall G f g c e, entails [] (nnf true c) -> feq (norm (nnf false (counterexample G f g))) (norm c) = true ->
    all e G -> holds e f -> holds e g).
  { intros G f g c e h k a b. apply feq_ok in k. apply NNPP. intro n. specialize (h e). rewrite negated_ok in h.
    apply h; [constructor|]. rewrite <- norm_ok, <- k, norm_ok, (nnf_ok _ e false). apply conj_fold. apply all_app.
    split; auto. apply all_cons. split; auto. apply all_cons. split; [apply negated_ok; auto|constructor]. }
  intros G f g c d h1 h2 k1 k2 e a. split; intros b; [apply (x G f g c e)|apply (x G g f d e)]; auto.
Qed.
(* END *)
