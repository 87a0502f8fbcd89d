"""Rules about arms: checkers of what is said of joint positions, and of joints along curves, with the sentences that
they prove. They read exact data only; how an arm is planned or solved belongs elsewhere."""
