fn main() -> Result<(), MotionError<f64>> {
    let arm = Arm::default();
    println!("coordinates: {:?}", Arm::COORDINATES);
    // Accelerations at a state; inputs come in the order of the attribute, here two of them.
    let start = State::at_rest([0.1; Arm::COORDINATES.len()]);
    println!("{:?}", arm.accelerations(&start, &[1.0, 0.0])?);
    // A motion under error control, with these inputs from 0 s to 1 s.
    let mut motion = arm.simulate(start).with_inputs([1.0, 0.0]);
    println!("{:?}", motion.advance_to(1.0)?);
    Ok(())
}
